#pragma once
/// Channels of a file that go together: those of one length and one clock.

#include <optional>
#include <vector>

#include "libio/measured/raw_record.hpp"

namespace whirl::inline io {

/// Parts of a record, each with the channels that have one length and one clock, and with a note
/// that names all channels of the file that it has not. The first one is the record: the channels
/// that are as long as its times, or where there are none the length and clock of most channels,
/// of as many the longer ones. Vectors too short for a measurement are in no part, unless the file
/// has no others.
///
/// @param times  the record's channel of times, which `raw` has no more; nothing: it has none
/// @return       one part or more; one without channels, if there are none. The first one has the
///               times, too, unless all channels have clocks of their own
/// @throws ModelError  where no channel is as long as the times
std::vector<RawRecord> parts_of(RawRecord raw, std::optional<RawChannel> times);

}  // namespace whirl::inline io
