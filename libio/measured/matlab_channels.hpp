#pragma once
/// Channels in the variables of a MATLAB file, also in structs and cells within one another.

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "libio/measured/raw_record.hpp"
#include "libio/results/matlab_variables.hpp"

namespace whirl::inline io {

/// Takes channels variable by variable. A channel is called by the last name of its path, "b" of
/// "a{2}.b", or by all of it where others have that name.
///
/// A vector t or a number fs goes for what stands beside it: in a struct for that struct alone. A
/// struct of times and one vector or matrix called data or values is a channel of the struct's
/// name.
class MatlabChannels {
 public:
  explicit MatlabChannels(const std::string& file);

  /// Takes a variable.
  /// @throws ModelError  for texts of names and units that are not as many as channels, and for two
  ///                     rates beside each other
  void take(const matvar_t& v, const std::string& name);

  /// @throws ModelError  for a file without channels: it says what it has
  RawRecord finished();

 private:
  /// What stands beside each other: in the file, or in one struct.
  struct Level {
    std::string path;                       ///< of the struct; "": the file
    std::size_t first = 0;                  ///< of its channels
    std::optional<double> rate{}, start{};  ///< [1/s], [s]
    std::vector<std::string> names{}, units{}, label{};
    int depth = 0;
  };

  void take_at(Level& level, const matvar_t& v, const std::string& name, const std::string& path);
  void take_struct(const matvar_t& v, const std::string& path, int depth);
  void take_cells(Level& level, const matvar_t& v, const std::string& path);
  void add(const matvar_t& v, const std::string& name, const std::string& path,
           const std::vector<double>& numbers);
  void leave_out(const std::string& path, const std::string& why);
  void finish(const Level& level);
  int clock_of(const RawClock& clock);
  void set_clock(const Level& level);
  void set_texts(const Level& level, const std::vector<std::string>& texts, const char* variable,
                 std::string RawChannel::*member);

  RawRecord raw_;
  Level file_;
  /// Clocks by rate, start, number of times and the last of these.
  std::map<std::tuple<double, double, std::size_t, double>, std::size_t> clocks_;
  std::string others_;
};

}  // namespace whirl::inline io
