#pragma once
// One mass on springs, for tests of linear verbs.

#include "tests/cli/program.hpp"

namespace whirl::test {

/// The folder has it as rotor.toml.
class Linear : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("rotor.toml", jeffcott);
  }
};

}  // namespace whirl::test
