#pragma once
/// What verbs take that draw, export and report what is there, and the files that they write.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "libio/export/scene_source.hpp"
#include "libio/figures/figures.hpp"
#include "libverbs/command/invocation.hpp"
#include "libverbs/options/common.hpp"

namespace whirl::inline cli {

/// Whether the file of a call is TOML by its name, as models are.
bool is_model_file(const Invocation& call);

/// What to do first where a result is needed and a model is given.
/// @param kind  of the figure that is wanted; empty: any
FileError no_result(const Invocation& call, const std::string& kind);
/// Says it.
/// @param kind  of the figure that is wanted; empty: any
/// @throws FileError  if the call's file is TOML by its name, and no HDF5 file
void require_result(const Invocation& call, const std::string& kind);

/// Shows frequencies in the unit of --frequency, or, where it is left out, in that of --units.
/// @throws ModelError  for another than Hz, cpm and rad/s
void set_frequency_unit(const Option<std::string>& unit, ResultView& result);

/// @throws ModelError  if --times stands beside other options of a window
MotionWindow window_of(const WindowVerbOptions& options);

/// The model or result of a call, as a scene.
SceneSource scene_source(const Invocation& call);

/// Files that were written, for JSON.
Record file_list(const std::vector<std::filesystem::path>& files);

}  // namespace whirl::inline cli
