#pragma once
/// What a model says of orders that were measured: its unbalance response beside them, and which of
/// its modes the shape at a peak is most like.

#include "libbase/structs/field.hpp"
#include "libdata/measured/order_tracking.hpp"
#include "libdyn/motions/identify.hpp"
#include "libdyn/system/model.hpp"

namespace whirl::inline data {

/// How large the model's unbalances are taken to be.
enum class ModelScale {
  fit,  ///< times one factor and turned by one angle, which fit all 1X readings best
  own   ///< as the model has them
};
constexpr auto choices(ModelScale) {
  return std::array{Choice<ModelScale>{"fit", ModelScale::fit},
                    Choice<ModelScale>{"own", ModelScale::own}};
}

/// Adds the model's response to its unbalances, bow and forces of order 1 to all 1X curves.
///
/// It is computed at the speeds of the points, or at 400 equal steps where there are more, with
/// straight lines between. The factor s is the least-squares solution over all probes and points,
///
///   s = sum conj(m) y / sum |m|^2,   m of the model, y measured
///
/// @param probes  of the record, in the order of the curves
/// @throws OptionError  for a model without unbalance, and for orders without 1X
void add_model_curve(OrderTracking& tracking, const Assembler& assembler,
                     const std::vector<Probe>& probes, ModelScale scale);

/// Compares 1X shapes with modes, at the peaks of the root of the sum of squares of all probes:
/// modes are those of the model at the speed of each peak.
///
/// @param options  how many modes, and of which rotor
void add_shapes(OrderTracking& tracking, const Model& model, const std::vector<Probe>& probes,
                const IdentifyOptions& options);

}  // namespace whirl::inline data
