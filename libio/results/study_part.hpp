#pragma once
/// Studies that several calls share: which part each computes, and where its file is.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "libdyn/studies/stripe.hpp"
#include "libio/results/call.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

/// Reads "3/40", the third of forty parts.
Parsed<Stripe> parse_stripe(std::string_view text);

/// The part of a study that a value of --part asks for; all, if it is empty.
/// @throws ModelError  naming the option
Stripe stripe_named(const std::string& part);
/// The part of a study that a call asks for.
Stripe stripe_of(const Call& call);
/// The call of the whole study.
Call without_part(Call call);

/// Where a part's file is: "atlas.part3of40.h5" of "atlas.h5".
std::filesystem::path part_place(const std::filesystem::path& whole, const Stripe& stripe);

/// What files of parts leave open, a line each: "part 7/40 (all)", "part 12/40 (311 of 2500
/// points)".
/// @param files  results of one study
/// @throws FileError  as ResultReader
std::vector<std::string> missing_parts(const std::vector<std::filesystem::path>& files);

}  // namespace whirl::inline io
