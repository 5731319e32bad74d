#pragma once
/// Tables of model files: a family, each in a file of its own in tables/.

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "libbase/structs/field.hpp"

namespace whirl::inline io {

class ModelReading;

/// What a key means that is not read as a field of a struct.
struct KeyNote {
  std::string_view key;  ///< in its table; of an inline table `inner.key`, of a list `list.[].key`
  std::string_view meaning;
  std::string_view otherwise = "";  ///< what holds if it is left out, as it would be written
};

/// A key that decides what else its table holds: by its value where that is one of some names, else
/// by being there.
struct KeySwitch {
  std::string_view key;
  std::string_view otherwise = "";  ///< value if it is left out; empty: other keys tell it
};

/// A table of model files.
///
/// The reader, the schema, the Python builder and the test of the manual take it from here. `bare`,
/// `as_tables` and `as_values` need not be right: they are read so that the reader asks for every
/// key that it knows, in every form that the key may have; the schema is what was asked for.
struct ModelTable {
  enum class Form { one, several, named };  ///< [damping], [[disk]], [material.NAME]
  enum class Turn { early, middle, late };  ///< in which it is read

  std::string_view name, meaning;
  Form form = Form::several;
  /// Reads all tables of this name; there may be none.
  void (*read)(ModelReading& reading) = nullptr;
  /// Early: other tables name what this one holds. Late: this one adds to what others hold.
  Turn turn = Turn::middle;
  /// Whether its values change the rotor: its mesh, matrices or loads. Tables whose values do not
  /// are the only ones that are read again for a member of a family, see ModelFamily: into a Model
  /// in which they have not been read.
  bool is_of_rotor = true;
  /// A right one, of a model with a material steel, a shaft and a body b that spins.
  std::string_view example = "";
  std::string_view bare = "";       ///< nothing but its inner tables, which are empty
  std::string_view as_tables = "";  ///< keys as tables or lists that may be plain values, too
  std::string_view as_values = "";  ///< those of them as plain values that are not tried above
  std::vector<KeySwitch> switches{};
  std::vector<KeyNote> notes{};

  /// How it begins in a file: "[damping]", "[[disk]]", "[material.NAME]".
  std::string header() const;
  /// Its path in the schema: "damping", "disk.[]", "material.*".
  std::string path() const;
};

constexpr auto choices(ModelTable::Form) {
  using enum ModelTable::Form;
  return std::array{Choice<ModelTable::Form>{"one", one},
                    Choice<ModelTable::Form>{"several", several},
                    Choice<ModelTable::Form>{"named", named}};
}

/// All tables, in the order of the schema.
const std::vector<ModelTable>& model_tables();

}  // namespace whirl::inline io
