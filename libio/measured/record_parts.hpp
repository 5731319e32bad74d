#pragma once
/// Channels of a file that go together: those of one length and one clock.

#include <vector>

#include "libio/measured/raw_record.hpp"

namespace whirl::inline io {

/// Parts of a record, each with the channels that have one length and one clock, and with a note
/// that names all channels of the file that it has not. The first one is the record: the channels
/// that are as long as its times, or where there are none the length and clock of most channels,
/// of as many the longer ones. Vectors too short for a measurement are in no part, unless the file
/// has no others.
///
/// @param raw           channels by the record's own clock have their times no more
/// @param time_samples  of the record's channel of times; 0: it has none
/// @return              one part or more; one without channels, if there are none
std::vector<RawRecord> parts_of(RawRecord raw, std::size_t time_samples);

}  // namespace whirl::inline io
