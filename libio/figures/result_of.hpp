#pragma once
/// What figures draw: results as structs, read once for all figures of a file.

#include <typeinfo>

#include "libio/figures/drawn_grid.hpp"
#include "libio/figures/figures.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/dataset_path.hpp"

namespace whirl::inline io::figures {

/// What the file holds of a result; members that the file is without are as in a new struct.
/// @return  valid as long as the view
template <HasGroup T>
const T& result_of(const ResultView& view) {
  std::shared_ptr<const void>& known = view.known[typeid(T)];
  if (!known) known = std::make_shared<const T>(read_result<T>(view.file));
  return *static_cast<const T*>(known.get());
}

/// The same of a study, of which only those points are read that are drawn.
template <class Study>
const Study& study_of(const ResultView& view) {
  std::shared_ptr<const void>& known = view.known[typeid(Study)];
  if (!known)
    known = std::make_shared<const Study>(
        stored_study<Study>(view.file, drawn_grid(view.file, Study::group)));
  return *static_cast<const Study*>(known.get());
}

}  // namespace whirl::inline io::figures
