#pragma once
/// What the reader of model files asks for, noted while it reads: the schema is made of it.

#include <string>
#include <vector>

#include "libbase/structs/field.hpp"

namespace whirl::inline io {

/// A key that was asked for, and a way in which its value may be written or must be there.
struct AskedKey {
  enum class Form {
    known,     ///< of any form; other entries with its path say which
    quantity,  ///< a number or a text with a unit
    pair,      ///< a list of two quantities
    list,      ///< a list of one or more quantities
    rows,      ///< a matrix by its rows, or one row
    integer,
    boolean,
    text,
    choice,   ///< one of `names`
    table,    ///< with entries of its own
    limit,    ///< `most` of an integer
    field,    ///< `meaning` and `otherwise` of a field
    missing,  ///< one of `names` (last parts of paths) is needed
  };
  Form form = Form::known;
  std::string path{};                ///< of the key, as in messages: contact.1.stiffness
  std::string unit{};                ///< SI unit of quantities
  Range range = Range::any;          ///< of quantities and integers
  long most = 0;                     ///< of integers
  std::vector<std::string> names{};  ///< of choices; of a missing key, its own among them
  std::string meaning{};             ///< half a sentence
  std::string otherwise{};           ///< what holds if it is left out, as it would be written
};

}  // namespace whirl::inline io
