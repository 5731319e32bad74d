#pragma once
/// Words of the field for what whirl has under another name.

#include <array>
#include <string_view>

namespace whirl::inline cli {

/// A word that people look for as a verb, and the command lines that lead to it.
struct FieldWord {
  std::string_view word;
  std::string_view place;  ///< half a sentence with command lines in it
};

constexpr std::string_view of_stability =
    "`whirl lateral MODEL`, or `whirl campbell MODEL`, which "
    "tells the threshold of instability";

/// In the order of docs/command-line.md, whose table a test compares.
constexpr std::array field_words{
    FieldWord{"bode", "`whirl unbalance MODEL --out u.h5`, then `whirl plot u.h5 bode`"},
    FieldWord{"polar", "`whirl unbalance MODEL --out u.h5`, then `whirl plot u.h5 polar`"},
    FieldWord{"nyquist", "`whirl unbalance MODEL --out u.h5`, then `whirl plot u.h5 polar`"},
    FieldWord{"eigenvalues", "`whirl modes MODEL`"},
    FieldWord{"eigenfrequencies", "`whirl modes MODEL`"},
    FieldWord{"stability", of_stability},
    FieldWord{"api617", "`whirl lateral MODEL`"},
    FieldWord{"waterfall",
              "`whirl simulate MODEL --out run.h5`, then `whirl plot run.h5 waterfall`; "
              "over speed `cascade`"},
    FieldWord{"cascade",
              "`whirl sweep MODEL --over operation.speed=A:B:STEP --out s.h5`, then "
              "`whirl plot s.h5 cascade`"},
    FieldWord{"spectrum", "`whirl simulate MODEL --out run.h5`, then `whirl plot run.h5 spectrum`"},
    FieldWord{"fft", "`whirl simulate MODEL --out run.h5`, then `whirl plot run.h5 spectrum`"},
    FieldWord{"transient", "`whirl simulate MODEL --discard 0`"},
    FieldWord{"bifurcation",
              "`whirl sweep MODEL --over PATH=A:B:STEP --out s.h5`, then `whirl plot "
              "s.h5 bifurcation`; branches of orbits, unstable ones too: `whirl "
              "continue`"},
    FieldWord{"continuation", "`whirl continue MODEL --over PATH=A:B`"},
    FieldWord{"poincare", "`whirl simulate MODEL --out run.h5`, then `whirl plot run.h5 poincare`"},
    FieldWord{"lyapunov",
              "`whirl classify MODEL`, along a value `whirl sweep`, in a plane `whirl "
              "map`"},
    FieldWord{"floquet", "`whirl orbit MODEL`"},
    FieldWord{"chaos", "`whirl classify MODEL`"},
    FieldWord{"attractors", "`whirl basins MODEL`"},
    FieldWord{"mac", "`whirl identify MODEL`"},
    FieldWord{"oma", "`whirl identify MODEL --measured FILE --running-modes`"},
};

/// Where a word leads; empty: it is none of field_words.
constexpr std::string_view place_of(std::string_view word) {
  for (const FieldWord& field : field_words) {
    if (field.word == word) return field.place;
  }
  return "";
}

}  // namespace whirl::inline cli
