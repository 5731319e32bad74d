// whirl balance: a rotor with weights on it vibrates as was predicted.

#include <fmt/format.h>

#include <cmath>
#include <complex>

#include "tests/cli/program.hpp"

namespace whirl::test {
namespace balance_test {

using Complex = std::complex<double>;

class Balance : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    // without its start among the modes that bounce
    std::string model = content(WHIRL_SOURCE_DIR "/models/two_disk_mac.toml");
    machine_ = model.substr(0, model.find("[start]"));
    write("rotor.toml", machine_ + probes());
  }

  static std::string probes() {
    std::string text;
    for (const auto& [name, node] : {std::pair{"DE", 4}, {"ring", 7}, {"NDE", 10}}) {
      text += fmt::format("[[probe]]\nname = \"{}\"\nnode = {}\nangle = \"45 deg\"\n", name, node);
    }
    return text;
  }
  /// The machine with weights at both disks, [kg] at 100 mm.
  std::string with(const std::string& file, Complex left, Complex right) {
    std::string text = machine_ + probes();
    for (const auto& [node, w] : {std::pair{4, left}, {9, right}}) {
      text += fmt::format("[[unbalance]]\nnode = {}\nmoment = {:.17g}\nphase = {:.17g}\n", node,
                          0.1 * std::abs(w), std::arg(w));
    }
    write(file, text);
    return file;
  }
  /// What the probes read of a model, peak to peak with phase ahead.
  json readings(const std::string& file) const {
    return whirl({"unbalance", file, "--speeds", "1500:1500:1rpm", "--json", "-"}).tree().at("probes");
  }
  static Complex vector_of(const json& probe) {
    return std::polar(probe.at("peak_to_peak_m")[0].get<double>() / 2.0,
                      probe.at("phase_deg")[0].get<double>() * pi / 180.0);
  }
  /// A run with these readings; phases lag.
  static std::string run_of(const json& probes, const std::string& weights) {
    std::string text = "[[run]]\nspeed = \"1500 rpm\"\n" + weights + "readings = [";
    for (const json& p : probes) {
      text +=
          fmt::format("{{ probe = \"{}\", amplitude = \"{:.17g} m\", phase = \"{:.17g} deg\" }},",
                      p.at("name").get<std::string>(), p.at("peak_to_peak_m")[0].get<double>(),
                      -p.at("phase_deg")[0].get<double>());
    }
    return text + "]\n";
  }
  static Complex complex(const json& pair) { return {pair[0], pair[1]}; }

  const std::string planes =
      "phase = \"lag\"\nangles = \"against rotation\"\n"
      "[[plane]]\nname = \"left\"\nnode = 4\nradius = \"100 mm\"\n"
      "[[plane]]\nname = \"right\"\nnode = 9\nradius = \"100 mm\"\n";
  std::string machine_;
};

// Trial runs by `unbalance`, one plane of weights at the wrong place of the rotor: what remains is
// not zero, and the model with the weights has it. Coefficients of the model are those of the runs.
TEST_F(Balance, PredictsWhatTheRotorWithItsWeightsDoes) {
  const std::string trial_left =
                        "weights = [{ plane = \"left\", mass = \"20 g\", angle = \"-30 deg\" }]\n",
                    trial_right =
                        "weights = [{ plane = \"right\", mass = \"10 g\", angle = \"90 deg\" }]\n";
  // angles count against rotation: -30 deg is 30 deg with it
  write("runs.toml",
        planes + run_of(readings("rotor.toml"), "") +
            run_of(readings(with("1.toml", std::polar(0.02, pi / 6.0), 0.0)), trial_left) +
            run_of(readings(with("2.toml", 0.0, std::polar(0.01, -pi / 2.0))), trial_right));
  for (const char* criterion : {"least-squares", "min-max"}) {
    const json of_runs = whirl({"balance", "rotor.toml", "--runs", "runs.toml", "--criterion",
                                criterion, "--json", "-"})
                             .tree();
    const json of_model = whirl({"balance", "rotor.toml", "--runs", "runs.toml", "--criterion",
                                 criterion, "--coefficients", "model", "--json", "-"})
                              .tree();
    const Complex left = complex(of_runs.at("planes")[0].at("placed_kg")),
                  right = complex(of_runs.at("planes")[1].at("placed_kg"));
    EXPECT_NEAR(std::abs(left - complex(of_model.at("planes")[0].at("placed_kg"))), 0.0, 1e-9);
    // the offset of 0.5 mm of the left disk is all that there is: 100 mm w = -m 0.5 mm
    EXPECT_NEAR(std::arg(-left), 0.0, 1e-6);
    EXPECT_NEAR(std::abs(right), 0.0, 1e-8);
    const json after = readings(with("after.toml", left, right));
    for (std::size_t p = 0; p < after.size(); ++p) {
      const Complex predicted = complex(of_runs.at("readings")[p].at("after")),
                    before = complex(of_runs.at("readings")[p].at("before"));
      EXPECT_LT(std::abs(vector_of(after[p]) - predicted), 1e-7 * std::abs(before));
    }
    EXPECT_EQ(whirl({"balance", "rotor.toml", "--runs", "runs.toml"}).status, 0);
  }
}

// A limit below what is needed: what remains is the prediction for weights that are not enough.
TEST_F(Balance, PredictsWhatALimitAndHolesLeave) {
  std::string text = planes;
  text.replace(
      text.find("radius"), 0,
      "limit = \"12 g\"\nholes = { count = 8, pieces = [\"1 g\"], pieces_per_hole = 5 }\n");
  write("self.toml", text);
  const json found = whirl({"balance", "rotor.toml", "--runs", "self.toml", "--speed", "1500rpm",
                            "--criterion", "min-max", "--json", "-"})
                         .tree();
  const json& rows = found.at("planes");
  const Complex left = complex(rows[0].at("placed_kg")), right = complex(rows[1].at("placed_kg"));
  EXPECT_LE(std::abs(complex(rows[0].at("weight_kg"))), 12e-3);
  EXPECT_GT(found.at("holes").size(), 0u);
  const json after = readings(with("after.toml", left, right));
  for (std::size_t p = 0; p < after.size(); ++p) {
    const json& row = found.at("readings")[p];
    EXPECT_LT(std::abs(vector_of(after[p]) - complex(row.at("after"))),
              1e-9 * std::abs(complex(row.at("before"))));
    EXPECT_GT(std::abs(complex(row.at("after"))), 0.01 * std::abs(complex(row.at("before"))));
  }
}

// Records of simulated runs give the weights that the model's own coefficients give; a rotor that
// bounces in its ring is refused.
TEST_F(Balance, TakesRecordsAndRefusesARotorThatRubs) {
  write("probes.toml", probes() + "[keyphasor]\nchannel = \"key\"\n");
  const auto record = [&](const std::string& model, const std::string& speed,
                          const std::string& file) {
    return whirl({"simulate", model, "--speed", speed, "--discard", "1500", "--revolutions", "40",
                  "--measure", "probes.toml", "--measured-out", file})
        .status;
  };
  ASSERT_EQ(record("rotor.toml", "1500rpm", "first.csv"), 0);
  ASSERT_EQ(record(with("1.toml", 0.02, 0.0), "1500rpm", "left.csv"), 0);
  ASSERT_EQ(record(with("2.toml", 0.0, 0.02), "1500rpm", "right.csv"), 0);
  const std::string head = "probes = \"probes.toml\"\nallowed = \"20 um\"\n" + planes;
  write("runs.toml", head +
                         "[[run]]\nrecord = \"first.csv\"\n"
                         "[[run]]\nrecord = \"left.csv\"\n"
                         "weights = [{ plane = \"left\", mass = \"20 g\", angle = 0 }]\n"
                         "[[run]]\nrecord = \"right.csv\"\n"
                         "weights = [{ plane = \"right\", mass = \"20 g\", angle = 0 }]\n");
  const json found =
      whirl({"balance", "rotor.toml", "--runs", "runs.toml", "--json", "-", "--out", "b.h5"})
          .tree();
  write("self.toml", head);
  const json self =
      whirl({"balance", "rotor.toml", "--runs", "self.toml", "--speed", "1500rpm", "--json", "-"})
          .tree();
  constexpr double reduced = 2e-3;  // a simulation has eight modes, the response all of them
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_LT(std::abs(complex(found.at("planes")[k].at("weight_kg")) -
                       complex(self.at("planes")[k].at("weight_kg"))),
              reduced * 0.05);
  }
  EXPECT_NEAR(found.at("readings")[0].at("allowed").get<double>(), 20.0, 1e-9);
  EXPECT_EQ(whirl({"plot", "b.h5", "balancing", "--out", "b.svg"}).status, 0);
  EXPECT_EQ(whirl({"plot", "b.h5", "balancing", "--which", "weights", "--out", "w.svg"}).status, 0);

  const std::string bouncing = content(WHIRL_SOURCE_DIR "/models/two_disk_mac.toml");
  write("bouncing.toml", bouncing);
  ASSERT_EQ(record("bouncing.toml", "4430rpm", "rub.csv"), 0);
  write("rub.toml", head + "[[run]]\nrecord = \"rub.csv\"\n");
  const Outcome refused = whirl({"balance", "bouncing.toml", "--runs", "rub.toml"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_TRUE(has(refused.err, "as of a rotor that rubs")) << refused.err;
}

}  // namespace balance_test
}  // namespace whirl::test
