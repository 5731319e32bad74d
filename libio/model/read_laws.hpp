#pragma once
/// Keys of linear laws with states: of supports and of controllers.

#include <optional>

#include "libfe/parts/transfer_function.hpp"
#include "libio/model/model_reading.hpp"

namespace whirl::inline io {

/// A table in an array of tables, whose files are known by these.
struct LawOwner {
  const char* name;      ///< "support"
  std::size_t item = 0;  ///< from 0
};

/// The keys numerator and denominator, poles and residues, A, B, C and D, or state_space, a file
/// with these matrices.
/// @param form  of the numerator and denominator, or of the poles and residues
/// @return  force over displacement; nothing: none of the keys is there, or it is wrong, which is
///          reported
std::optional<StateSpace> read_law(ModelReading& reading, TableReader& table, LawOwner owner,
                                   TransferForm form);

/// The keys numerator and denominator alone; nothing: one is missing or wrong, which is reported.
std::optional<TransferFunction> read_function(TableReader& table);

/// A coordinate along a direction at an angle from +x to +y [rad]; right angles are exact.
InterfaceCoordinate interface_along(const Station& at, const Station& to, double angle);

/// The station at the other side of what stands at `at`, by its key `to`; left out: the ground.
Station other_side(ModelReading& reading, TableReader& table, const std::optional<Station>& at);

/// Whether any of these keys is there.
bool has_law(const TableReader& table);

}  // namespace whirl::inline io
