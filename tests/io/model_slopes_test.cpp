// Slopes of scenes by values of their model files.

#include "libio/model/model_slopes.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libio/model/model_file.hpp"

namespace whirl::model_slopes_test {

const std::string two_disk = std::string(WHIRL_SOURCE_DIR) + "/models/two_disk_mac.toml";

ParameterAxis axis(const std::string& text) {
  const auto parsed = parse_axis(text, 0);
  EXPECT_TRUE(parsed) << parsed.problem;
  return *parsed;
}

/// Slope of a number of a system.
template <class Of>
double slope(const SystemSlope& s, Of of) {
  double sum = 0.0;
  for (std::size_t j = 0; j < s.neighbors.size(); ++j)
    sum += neighbor_weights[j] * of(s.neighbors[j]);
  return sum / s.step;
}

constexpr double rounding = 1e-11;  // of coefficients, over a step of 1 / 128

TEST(ModelSlopes, AreThoseOfCoefficientsInHeldShapes) {
  const Model base = read_model(two_disk);
  const std::string contact = "contact." + base.contacts.at(0).name;
  const std::vector<ParameterAxis> axes{axis(contact + ".stiffness=1e6 N/m"),
                                        axis("operation.speed=400"),
                                        axis("bearing.left.stiffness=4e6 N/m")};
  const ModelFamily family(base, axes);
  const std::vector<double> values{1e6, 400.0, 4e6};
  const auto scene = family.scene(values);
  const auto slopes = slopes_of(family, axes, *scene, values);
  ASSERT_EQ(slopes.size(), 3u);
  EXPECT_EQ(slopes[0].name, contact + ".stiffness");

  const auto law = [](const ContactSystem& s) { return std::get<Radial<>>(s.contacts()[0].law).k; };
  EXPECT_NEAR(slope(slopes[0], law), 1.0, rounding);
  for (const SystemSlope& s : slopes) {
    const auto shape = [](const ContactSystem& of) { return of.contacts()[0].U.norm(); };
    EXPECT_NEAR(slope(s, shape), 0.0, rounding * scene->contacts.contacts()[0].U.norm());
  }
  // D = C + Omega G, fc = Omega^2 U e: both are known
  const double Omega = scene->contacts.Omega();
  const auto load = [](const ContactSystem& s) { return s.synchronous_load().cosine(0); };
  EXPECT_NEAR(slope(slopes[1], load) * Omega, 2.0 * load(scene->contacts),
              rounding * std::abs(load(scene->contacts)));
  // a bearing's stiffness at its station: dK = (dK/dk) with K - k dK/dk that of the shaft alone
  const auto K = [](const ContactSystem& s) { return s.K()(0, 0); };
  const double by_k = slope(slopes[2], K);
  EXPECT_GT(by_k, 0.0);
  EXPECT_NEAR(slopes[2].neighbors[0].K()(0, 0), K(scene->contacts) + slopes[2].step * by_k,
              rounding * K(scene->contacts));
}

TEST(ModelSlopes, NeedAValueToBeComparedWith) {
  const Model base = read_model(two_disk);
  const std::vector<ParameterAxis> axes{
      axis("contact." + base.contacts.at(0).name + ".friction=0")};
  const ModelFamily family(base, axes);
  const std::vector<double> values{0.0};
  EXPECT_THROW(slopes_of(family, axes, *family.scene(values), values), ModelError);
}

}  // namespace whirl::model_slopes_test
