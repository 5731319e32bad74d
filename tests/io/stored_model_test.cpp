// Models that results store, which a stranger may have written: no file is opened for them.

#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/stat.h>

#include "libio/figures/figures.hpp"
#include "libio/model/model_file.hpp"
#include "libio/results/branch_point.hpp"
#include "libio/results/call.hpp"
#include "tests/io/result_folder.hpp"

namespace whirl::stored_model_test {

namespace fs = std::filesystem;

constexpr std::string_view secret = "root:x:0:0\nof nobody's business\n";

/// A rotor whose key of that name is a table in another file.
std::string rotor_with(const std::string& shaft, const std::string& bearing,
                       const std::string& more) {
  return "format = 1\n[operation]\nspeed = \"200 rad/s\"\n"
         "[material.steel]\ndensity = 7800\nyoungs_modulus = 2e11\npoisson_ratio = 0.3\n"
         "[[shaft]]\nmaterial = \"steel\"\n" +
         shaft + "[[bearing]]\nat = 0.0\n" + bearing + "[[bearing]]\nat = 1.0\nstiffness = 1e7\n" +
         more;
}
const std::string plain_shaft = "length = 1.0\nouter_diameter = 0.03\nelements = 4\n";
const std::string plain_bearing = "stiffness = 1e7\n";

/// One for every kind of table that a model can name.
std::vector<std::string> rotors_with(const std::string& file) {
  const std::string quoted = "\"" + file + "\"\n";
  return {rotor_with("table = " + quoted, plain_bearing, ""),
          rotor_with(plain_shaft, "table = " + quoted, ""),
          rotor_with(plain_shaft, plain_bearing, "[bow]\ntable = " + quoted),
          rotor_with(plain_shaft, plain_bearing,
                     "[[rotor]]\nname = \"outer\"\nratio = 1.5\nbow = " + quoted)};
}

std::string problems_of(const std::string& text, const NamedFiles& files,
                        const std::vector<std::string>& sets = {}) {
  try {
    parse_model(text, "model.toml", sets, files);
  } catch (const ModelError& error) {
    std::string all;
    for (const Problem& problem : error.problems()) all += describe(problem) + "\n";
    return all;
  }
  return "none";
}

class StoredModel : public test::InResultFolder {
 protected:
  void SetUp() override {
    InResultFolder::SetUp();
    std::ofstream(file) << secret;
  }
  const fs::path file = folder / "secret.csv";
};

// A table that the text names is read where somebody named the model, and nowhere else.
TEST_F(StoredModel, OpensNoTable) {
  for (const std::string& text : rotors_with(file.string())) {
    const std::string stored = problems_of(text, {});
    EXPECT_NE(stored.find("no file is opened for it"), std::string::npos) << stored;
    EXPECT_EQ(stored.find("root:"), std::string::npos) << stored;
    const std::string named = problems_of(text, folder);
    EXPECT_NE(named.find("secret.csv:1"), std::string::npos) << named;
    for (const NamedFiles& none :
         {NamedFiles::of_sets_in(folder), NamedFiles::none_in(folder), NamedFiles()}) {
      EXPECT_EQ(problems_of(text, none), stored);
    }
  }
}

// What is set at the command line is no stranger's.
TEST_F(StoredModel, OpensTheTablesThatAreSet) {
  const std::string text = rotor_with(plain_shaft, plain_bearing, "[bow]\nat = [0, 1]\n");
  const std::vector<std::string> sets{"bow={table=\"" + file.string() + "\"}"};
  EXPECT_NE(problems_of(text, NamedFiles::of_sets_in(folder), sets).find("secret.csv"),
            std::string::npos);
  EXPECT_NE(problems_of(text, {}, sets).find("no file is opened for it"), std::string::npos);
}

// Tables are files: a device would fill the memory, a pipe would wait without end.
TEST_F(StoredModel, TablesAreFiles) {
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  for (const fs::path& place : {fs::path("/dev/zero"), folder / "pipe"}) {
    for (const std::string& text : rotors_with(place.string())) {
      const std::string said = problems_of(text, folder);
      EXPECT_NE(said.find("this is a device or a pipe, expected a file"), std::string::npos)
          << said;
    }
  }
}

// Once the first line of such a file stood in the page of a report.
TEST_F(StoredModel, OfAResultShowsNoFile) {
  for (const std::string& text : rotors_with(file.string())) {
    {
      ResultWriter out(path, Replaces::anything);
      const Model model{.title = "t", .source = text, .path = (folder / "m.toml").string()};
      write_origin(out, {{.verb = "modes", .file = "m.toml"}, {"whirl"}, "1"}, model);
      out.commit();
    }
    const ResultView view(path);
    EXPECT_FALSE(view.model.has_value());
    EXPECT_NE(view.problem.find("no file is opened for it"), std::string::npos) << view.problem;
    EXPECT_EQ(view.problem.find("root:"), std::string::npos) << view.problem;
  }
}

/// Sets a text attribute of a file.
void set_attribute(const fs::path& path, const char* object, const char* name, const char* value) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  if (H5Aexists_by_name(file, object, name, H5P_DEFAULT) > 0) {
    H5Adelete_by_name(file, object, name, H5P_DEFAULT);
  }
  const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  const hid_t attribute =
      H5Acreate_by_name(file, object, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(attribute, type, &value);
  H5Aclose(attribute);
  H5Sclose(space);
  H5Tclose(type);
  H5Fclose(file);
}

// The values at a point of a branch are set in the model of whoever goes on from there: they are
// numbers.
TEST_F(StoredModel, PointsOfBranchesSetNumbers) {
  const fs::path seed = WHIRL_SOURCE_DIR "/tests/fuzz/results/branch.h5";
  EXPECT_FALSE(read_branch_point(seed, 1).sets.empty());
  for (const char* set : {"bearing.1.table=\"/etc/passwd\"", "title=x"}) {
    fs::copy_file(seed, path, fs::copy_options::overwrite_existing);
    set_attribute(path, "/branch", "fixed", set);
    const std::string said = test::problem_of([&] { read_branch_point(path, 1); });
    EXPECT_NE(said.find("expected a number"), std::string::npos) << said;
  }
}

// Files say in which order the parts of a state stand; those of earlier versions do not, and have
// the order of today. A file with another one is not read as if it had this one.
TEST_F(StoredModel, PointsOfBranchesHaveStatesOfAKnownLayout) {
  const fs::path earlier = WHIRL_SOURCE_DIR "/tests/fuzz/results/branch.h5";
  const Vec state = read_branch_point(earlier, 1).state;
  fs::copy_file(earlier, path, fs::copy_options::overwrite_existing);
  set_attribute(path, "/branch", "state_layout", std::string(StateLayout::parts).c_str());
  EXPECT_EQ(read_branch_point(path, 1).state, state);
  set_attribute(path, "/branch", "state_layout", "rates, displacements");
  const std::string said = test::problem_of([&] { read_branch_point(path, 1); });
  EXPECT_NE(said.find("rates, displacements"), std::string::npos) << said;
}

}  // namespace whirl::stored_model_test
