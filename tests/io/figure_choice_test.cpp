// What a result can be drawn as, and choosing of it.

#include <gtest/gtest.h>

#include "libbase/error.hpp"
#include "libdyn/system/stations.hpp"
#include "libfe/analyses/modes.hpp"
#include "libio/figures/choice.hpp"
#include "libio/results/columns.hpp"
#include "tests/io/result_folder.hpp"
#include "tests/io/shaft_model.hpp"

namespace whirl::test {
namespace figure_choice_test {

class ChosenFigure : public InResultFolder {
 protected:
  /// A result of the modes of a shaft.
  void SetUp() override {
    InResultFolder::SetUp();
    const Model model = rotor(R"([[bearing]]
at = 0
stiffness = "1 MN/m"
[[bearing]]
at = 0.6
stiffness = "1 MN/m"
)");
    const Assembler assembler(model.structure);
    const System system = assembler.at(0.0);
    ResultWriter file(path);
    file.dataset("/model", std::vector<std::string>{model.source}, {"", "model file", {""}});
    write_result(file, point_names(model, assembler));
    write_result(file, ModesAtPoints(complex_modes(system, 2), system.dofs));
    file.commit();
  }

  std::string refusal(const FigureChoice& choice, const MotionWindow& window = {}) const {
    ResultView view(path);
    view.window = window;
    try {
      chosen_figure(view, choice);
    } catch (const ModelError& error) {
      return error.what();
    }
    return "none";
  }
};

TEST_F(ChosenFigure, KindsAndVariantsAreListed) {
  const DrawableKinds all = drawable_kinds(ResultView(path));
  ASSERT_EQ(all.kinds.size(), 2u);
  EXPECT_EQ(all.kinds[0].name, "layout");
  EXPECT_TRUE(all.kinds[0].variants.empty());
  EXPECT_EQ(all.kinds[1].name, "modes");
  EXPECT_EQ(all.kinds[1].variants, (std::vector<std::string>{"all", "mode 1", "mode 2"}));
  EXPECT_TRUE(all.problems.empty());
}

TEST_F(ChosenFigure, IsTheFirstOrTheOneOfAName) {
  const ResultView view(path);
  EXPECT_EQ(chosen_figure(view, {"modes"}).variant, "all");
  EXPECT_EQ(chosen_figure(view, {"modes", "mode 2"}).variant, "mode 2");
  EXPECT_EQ(chosen_figure(view, {"modes", "1"}).variant, "mode 1");  // a part of its name
}

TEST_F(ChosenFigure, IsRefusedWithWhatThereIs) {
  const auto says = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(says(refusal({"mode"}), "did you mean \"modes\"?"));
  EXPECT_TRUE(says(refusal({"orbit"}), "it can be drawn as layout, modes"));
  EXPECT_TRUE(says(refusal({"modes", "mode 7"}), "there are all | mode 1 | mode 2"));
  EXPECT_TRUE(says(refusal({"modes"}, {.revolutions = 2.0}), "are of motions in time: orbit,"));
  EXPECT_TRUE(says(refusal({"modes", "", path.string()}), "bifurcation, map,"));
}

TEST(FigureKinds, HaveAVerbThatMakesTheirResults) {
  EXPECT_EQ(verb_for("campbell"), "campbell");
  EXPECT_EQ(verb_for("orbit"), "simulate");
  EXPECT_EQ(verb_for("spectrum"), "simulate");
  EXPECT_EQ(verb_for("mac"), "identify");
  EXPECT_EQ(verb_for("branches"), "continue");
  EXPECT_EQ(verb_for("borders"), "continue");
  EXPECT_EQ(verb_for("layout"), "simulate");
}

}  // namespace figure_choice_test
}  // namespace whirl::test
