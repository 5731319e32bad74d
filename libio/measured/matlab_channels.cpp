#include "libio/measured/matlab_channels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "libio/text/delimited.hpp"

namespace whirl::inline io {

namespace {

constexpr int deepest = 32;  ///< structs and cells within one another

std::size_t elements_of(const matvar_t& v) {
  return v.dims[0] * v.dims[1];
}

/// Numbers of a matrix, column by column; none: it is no matrix of real numbers.
std::vector<double> numbers_of(const matvar_t& v) {
  if (!v.data || v.rank != 2 || v.isComplex) return {};
  return matlab_doubles(v, v.data);
}

/// Rows of a matrix of characters, which stand column by column, or of cells of these.
std::vector<std::string> texts_of(const matvar_t& v) {
  if (v.data && v.class_type == MAT_C_CELL && v.rank == 2) {
    std::vector<std::string> all;
    const auto* cells = static_cast<matvar_t* const*>(v.data);
    for (std::size_t k = 0; k < elements_of(v); ++k) {
      const auto rows = cells[k] ? texts_of(*cells[k]) : std::vector<std::string>();
      all.push_back(rows.empty() ? "" : rows.front());
    }
    return all;
  }
  if (!v.data || v.class_type != MAT_C_CHAR || v.rank != 2) return {};
  const auto* bytes = static_cast<const char*>(v.data);
  const std::size_t count = elements_of(v), size = count > 0 ? v.nbytes / count : 0;
  if (size < 1 || size > 2) return {};
  std::vector<std::string> rows(v.dims[0]);
  for (std::size_t k = 0; k < count; ++k) rows[k % v.dims[0]] += bytes[k * size];
  for (std::string& row : rows) row.erase(row.find_last_not_of(' ') + 1);
  return rows;
}

/// Texts of a struct that stand for a name of what it has.
bool is_one_of_names(const std::string& name, std::initializer_list<std::string_view> known) {
  return std::find(known.begin(), known.end(), plain_name(name)) != known.end();
}

/// Why a variable of no numbers, texts, structs or cells is no channel; "": it may be anything.
std::string why_no_channel(const matvar_t& v) {
  switch (v.class_type) {
    case MAT_C_SPARSE:
      return "it is a sparse matrix";
    case MAT_C_OBJECT:
    case MAT_C_OPAQUE:
      return "it is an object of MATLAB, such as a timetable: save its times and values as vectors";
    default:
      break;
  }
  if (v.isComplex) return "it has complex numbers";
  if (v.rank > 2) return fmt::format("it has {} dimensions", v.rank);
  return "";
}

/// "b" of "a{2}.b", "a{2}" of "a{2}".
std::string last_name(const std::string& path) {
  const auto dot = path.rfind('.');
  return dot == std::string::npos ? path : path.substr(dot + 1);
}

}  // namespace

MatlabChannels::MatlabChannels(const std::string& file) {
  raw_.file = file;
}

void MatlabChannels::take(const matvar_t& v, const std::string& name) {
  take_at(file_, v, name, name);
}

void MatlabChannels::take_at(Level& level, const matvar_t& v, const std::string& name,
                             const std::string& path) {
  if (level.depth > deepest) {
    throw ModelError({raw_.file}, path, "has too many structs and cells within one another");
  }
  const std::string plain = plain_name(name);
  const std::vector<double> numbers = numbers_of(v);
  if (numbers.size() == 1 && names_rate(name)) {
    if (level.rate && *level.rate != numbers.front()) {
      throw ModelError({raw_.file}, path,
                       fmt::format("says {:.6g} samples per second, another variable beside it "
                                   "{:.6g}",
                                   numbers.front(), *level.rate));
    }
    level.rate = numbers.front();
  } else if (numbers.size() == 1 && name == "start") {
    level.start = numbers.front();
  } else if (numbers.size() > 1) {
    add(v, name, path, numbers);
  } else if (v.class_type == MAT_C_STRUCT && v.data && v.rank == 2) {
    take_struct(v, path, level.depth + 1);
  } else if ((plain == "channels" || plain == "units" || plain == "unit") &&
             (v.class_type == MAT_C_CHAR || v.class_type == MAT_C_CELL)) {
    (plain == "channels" ? level.names : level.units) = texts_of(v);
  } else if (is_one_of_names(name, {"label", "name"}) && v.class_type == MAT_C_CHAR) {
    level.label = texts_of(v);
  } else if (v.class_type == MAT_C_CELL && v.data && v.rank == 2) {
    take_cells(level, v, path);
  } else if (const std::string why = why_no_channel(v); !why.empty()) {
    leave_out(path, why);
  } else {
    others_ += (others_.empty() ? "" : ", ") + path;
  }
}

void MatlabChannels::take_struct(const matvar_t& v, const std::string& path, int depth) {
  auto* of = const_cast<matvar_t*>(&v);  // matio asks for one that may change, and changes nothing
  const unsigned fields = Mat_VarGetNumberOfFields(of);
  const char* const* names = Mat_VarGetStructFieldnames(of);
  if (!names || fields == 0) return;
  const std::size_t there = v.nbytes / sizeof(matvar_t*) / fields;
  const std::size_t count = std::min(elements_of(v), there);
  for (std::size_t k = 0; k < count; ++k) {
    Level level{.path = count == 1 ? path : fmt::format("{}({})", path, k + 1),
                .first = raw_.channels.size(),
                .depth = depth};
    for (unsigned i = 0; i < fields; ++i) {
      const matvar_t* field = Mat_VarGetStructFieldByIndex(of, i, k);
      if (field) take_at(level, *field, names[i], level.path + "." + names[i]);
    }
    finish(level);
  }
}

void MatlabChannels::take_cells(Level& level, const matvar_t& v, const std::string& path) {
  const auto* cells = static_cast<matvar_t* const*>(v.data);
  const std::size_t count = std::min(elements_of(v), v.nbytes / sizeof(matvar_t*));
  bool has_texts_only = true;
  for (std::size_t k = 0; k < count; ++k) {
    if (!cells[k]) continue;
    has_texts_only = has_texts_only && cells[k]->class_type == MAT_C_CHAR;
    const std::string cell = fmt::format("{}{{{}}}", path, k + 1);
    if (cells[k]->class_type == MAT_C_CHAR) continue;
    ++level.depth;
    take_at(level, *cells[k], cell, cell);
    --level.depth;
  }
  if (has_texts_only) others_ += (others_.empty() ? "" : ", ") + path;
}

void MatlabChannels::add(const matvar_t& v, const std::string& name, const std::string& path,
                         const std::vector<double>& numbers) {
  // columns are channels, or rows where these are longer
  const bool is_upright = v.dims[0] >= v.dims[1];
  const std::size_t count = std::min(v.dims[0], v.dims[1]), n = std::max(v.dims[0], v.dims[1]);
  for (std::size_t c = 0; c < count; ++c) {
    RawChannel& channel = raw_.channels.emplace_back();
    const std::string which = count == 1 ? "" : fmt::format("({})", c + 1);
    channel.name = last_name(name) + which;
    channel.path = path + which;
    channel.where = {raw_.file};
    channel.samples.resize(n);
    for (std::size_t j = 0; j < n; ++j) {
      channel.samples[j] = numbers[is_upright ? c * n + j : j * count + c];
    }
  }
}

void MatlabChannels::leave_out(const std::string& path, const std::string& why) {
  raw_.left_out.push_back({path, why});
  others_ += (others_.empty() ? "" : ", ") + path;
  constexpr std::size_t most_notes = 12;
  if (raw_.left_out.size() <= most_notes) {
    raw_.notes.push_back(fmt::format("left out: {}: {}", path, why));
  }
}

void MatlabChannels::finish(const Level& level) {
  if (level.depth > 0) set_clock(level);
  set_texts(level, level.units, "units", &RawChannel::unit);
  set_texts(level, level.names, "channels", &RawChannel::name);
}

/// Number of a clock, which another struct may have, too.
int MatlabChannels::clock_of(const RawClock& clock) {
  const std::vector<double>& times = clock.times.samples;
  const double last = times.empty() ? 0.0 : times.back();
  if (!std::isfinite(clock.rate.value_or(0.0) + clock.start + last)) {  // told later
    raw_.clocks.push_back(clock);
    return static_cast<int>(raw_.clocks.size()) - 1;
  }
  const auto [known, is_new] = clocks_.try_emplace(
      std::tuple(clock.rate.value_or(0.0), clock.start, times.size(), last), raw_.clocks.size());
  if (!is_new && raw_.clocks[known->second].times.samples == times) {
    return static_cast<int>(known->second);
  }
  raw_.clocks.push_back(clock);
  return static_cast<int>(raw_.clocks.size()) - 1;
}

/// Gives channels of a struct the times or the rate that stand beside them there, and one that is
/// called data the name of the struct.
void MatlabChannels::set_clock(const Level& level) {
  const auto begin = raw_.channels.begin() + static_cast<std::ptrdiff_t>(level.first);
  const auto stands_here = [&](const RawChannel& c) {
    return c.path.starts_with(level.path + ".") &&
           c.path.find('.', level.path.size() + 1) == std::string::npos;
  };
  const auto time = std::find_if(begin, raw_.channels.end(), [&](const RawChannel& c) {
    return !c.clock && stands_here(c) && names_time(c.name) && ascends(c.samples);
  });
  std::optional<RawChannel> times;
  if (time != raw_.channels.end()) {
    const bool has_others = std::any_of(begin, raw_.channels.end(), [&](const RawChannel& c) {
      return &c != &*time && !c.clock && c.samples.size() == time->samples.size();
    });
    if (has_others) {
      times = std::move(*time);
      times->name = "time";
      raw_.channels.erase(time);
    }
  }
  const double start = level.start.value_or(0.0);
  std::optional<int> timed;
  std::vector<RawChannel*> here;
  for (std::size_t i = level.first; i < raw_.channels.size(); ++i) {
    RawChannel& c = raw_.channels[i];
    if (stands_here(c)) here.push_back(&c);
    const bool has_times = times && c.samples.size() == times->samples.size();
    if (c.clock) continue;
    if (has_times) {
      if (!timed) timed = clock_of({level.rate, start, *times});
      c.clock = timed;
    } else if (level.rate) {
      c.clock = clock_of({level.rate, start, {}});
    }
  }
  // of one vector or matrix
  const auto stem = [](const std::string& name) { return name.substr(0, name.find('(')); };
  const bool are_data =
      !here.empty() && std::all_of(here.begin(), here.end(), [&](const RawChannel* c) {
        return stem(c->name) == stem(here.front()->name) &&
               is_one_of_names(stem(c->name), {"data", "values", "value", "signal", "y"});
      });
  if (!are_data || !level.names.empty()) return;
  const bool has_label = level.label.size() == 1 && !level.label.front().empty();
  for (RawChannel* c : here) {
    const auto bracket = c->name.find('(');
    const std::string which = bracket == std::string::npos ? "" : c->name.substr(bracket);
    if (has_label || times) {
      c->name = (has_label ? level.label.front() : last_name(level.path)) + which;
      c->path = level.path + which;
    }
  }
}

void MatlabChannels::set_texts(const Level& level, const std::vector<std::string>& texts,
                               const char* variable, std::string RawChannel::*member) {
  if (texts.empty()) return;
  std::vector<RawChannel*> named;
  for (std::size_t i = level.first; i < raw_.channels.size(); ++i) {
    named.push_back(&raw_.channels[i]);
  }
  if (texts.size() != named.size()) {
    std::erase_if(named, [](const RawChannel* c) { return names_time(c->name); });
  }
  // one unit goes for all
  const bool is_for_all = texts.size() == 1 && member == &RawChannel::unit;
  if (texts.size() != named.size() && !is_for_all) {
    throw ModelError(
        {raw_.file}, (level.path.empty() ? "" : level.path + ".") + variable,
        fmt::format("has {} texts, expected one for each of {}", texts.size(), named.size()));
  }
  for (std::size_t i = 0; i < named.size(); ++i) named[i]->*member = texts[is_for_all ? 0 : i];
}

RawRecord MatlabChannels::finished() {
  if (raw_.channels.empty()) {
    throw ModelError({raw_.file}, "",
                     fmt::format("has no vector or matrix of real numbers, and a damaged file has "
                                 "none either; it has {}",
                                 others_.empty() ? "nothing" : others_));
  }
  finish(file_);
  raw_.rate = file_.rate;
  raw_.start = file_.start.value_or(0.0);
  std::map<std::string, int> alike;
  for (const RawChannel& c : raw_.channels) ++alike[c.name];
  for (RawChannel& c : raw_.channels) {
    if (alike[c.name] > 1) c.name = c.path;
  }
  return std::move(raw_);
}

}  // namespace whirl::inline io
