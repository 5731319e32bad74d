// A table is read the same whatever a spreadsheet program saves it as, or refused with its place:
// never is a number off by a factor. Random numbers of the forms that people write, in all tables
// of whirl, with every delimiter, mark of decimals and encoding, and as a workbook.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <minizip/zip.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <random>

#include "libbase/numerics/random.hpp"
#include "libfe/assembly/assemble.hpp"
#include "libio/measured/probe_file.hpp"
#include "libio/measured/record_file.hpp"
#include "libio/model/model_file.hpp"
#include "tests/io/result_folder.hpp"

namespace whirl::test {
namespace table_forms_test {

using Cells = std::vector<std::string>;  // numbers with a point, words as they are

/// A table: a title with letters beyond ASCII, names of columns, rows.
struct Specimen {
  Cells head;
  std::vector<Cells> rows;
};

/// Digits as people and programs write them.
std::string number(std::mt19937_64& random, int digits, double from, double to) {
  return fmt::format("{:.{}f}", from + (to - from) * random_share(random), digits);
}

struct Kind {
  const char* name;
  std::function<Specimen(std::mt19937_64&)> make;
  /// All numbers that whirl has of a file.
  std::function<std::vector<double>(const std::filesystem::path&)> read;
};

Model model_of(const std::string& tables, const std::filesystem::path& folder) {
  return parse_model(
      "format = 1\n[material.steel]\ndensity = 7800\nyoungs_modulus = \"211 GPa\"\n"
      "poisson_ratio = 0.3\n" +
          tables,
      "m.toml", {}, folder);
}

const char* const straight_shaft =
    "[[shaft]]\nlength = 2\nouter_diameter = 0.1\nmaterial = \"steel\"\n"
    "[[bearing]]\nat = 0\nstiffness = 1e7\n[[bearing]]\nat = 2\nstiffness = 1e7\n";

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> tables{
      {"shaft",
       [](std::mt19937_64& random) {
         Specimen s{{"Length [mm]", "OD [mm]", "Added mass [kg]", "Material"}, {}};
         const int digits = static_cast<int>(random() % 4);
         for (int i = 0; i < 4; ++i) {
           s.rows.push_back({number(random, digits, 20, 1500), number(random, digits, 20, 400),
                             number(random, digits, 1, 90), "steel"});
         }
         return s;
       },
       [](const std::filesystem::path& file) {
         std::vector<double> all;
         const Model m = model_of(fmt::format("[[shaft]]\ntable = \"{}\"\n[[bearing]]\nat = 0\n"
                                              "stiffness = 1e7\n",
                                              file.filename().string()),
                                  file.parent_path());
         for (const Segment& part : m.structure.shaft) {
           all.insert(all.end(), {part.length, part.left.outer});
         }
         for (const Disk& disk : m.structure.disks) all.push_back(disk.m);
         return all;
       }},
      {"bearing",
       [](std::mt19937_64& random) {
         Specimen s{{"Speed [rpm]", "Kxx [N/m]", "Kyy [N/m]", "Cxx [N.s/m]", "Cyy [N.s/m]"}, {}};
         const int digits = static_cast<int>(random() % 4);
         for (int i = 1; i < 5; ++i) {
           s.rows.push_back({fmt::format("{}", 1000 * i), number(random, digits, 1e3, 9e6),
                             number(random, digits, 1e3, 9e6), number(random, digits, 1, 9e3),
                             number(random, digits, 1, 9e3)});
         }
         return s;
       },
       [](const std::filesystem::path& file) {
         const Model m = model_of(
             fmt::format("[[shaft]]\nlength = 2\nouter_diameter = 0.1\nmaterial = \"steel\"\n"
                         "[[bearing]]\nat = 0\ntable = \"{}\"\n[[bearing]]\nat = 2\n"
                         "stiffness = 1e7\n",
                         file.filename().string()),
             file.parent_path());
         std::vector<double> all;
         for (const double speed : {1000 * rpm, 2000 * rpm, 3000 * rpm, 4000 * rpm}) {
           const auto c = coefficients(m.structure.bearings[0].coefficients, speed);
           all.insert(all.end(), {c.K(0, 0), c.K(1, 1), c.C(0, 0), c.C(1, 1)});
         }
         return all;
       }},
      {"bow",
       [](std::mt19937_64& random) {
         Specimen s{{"Position [mm]", "x [um]", "y [um]"}, {}};
         const int digits = static_cast<int>(random() % 4);
         for (int i = 0; i < 5; ++i) {
           s.rows.push_back({fmt::format("{}", 400 * i), number(random, digits, -2e3, 2e3),
                             number(random, digits, -90, 90)});
         }
         return s;
       },
       [](const std::filesystem::path& file) {
         const Model m = model_of(
             straight_shaft + fmt::format("[bow]\ntable = \"{}\"\n", file.filename().string()),
             file.parent_path());
         const Bow& bow = m.structure.bow;
         std::vector<double> all = bow.z;
         all.insert(all.end(), bow.x.begin(), bow.x.end());
         all.insert(all.end(), bow.y.begin(), bow.y.end());
         return all;
       }},
      {"probes",
       [](std::mt19937_64& random) {
         Specimen s{{"Probe", "Position [mm]", "Angle [deg]", "Sensitivity [mV/um]", "Channel"},
                    {}};
         const int digits = static_cast<int>(random() % 4);
         for (const char* name : {"DE x", "DE y", "NDE x"}) {
           s.rows.push_back({name, number(random, digits, 1, 1990),
                             number(random, digits, -180, 180), number(random, digits, 1, 20),
                             fmt::format("{}", s.rows.size() + 1)});
         }
         return s;
       },
       [](const std::filesystem::path& file) {
         const MeasurementSetup setup = read_probe_file(file, model_of(straight_shaft, ""));
         std::vector<double> all;
         for (const auto& p : setup.probes) {
           all.insert(all.end(), {p.probe.at.z, p.probe.angle, p.gain.value});
         }
         return all;
       }},
      {"record",
       [](std::mt19937_64& random) {
         Specimen s{{"Time [s]", "x [um]", "y [um]"}, {}};
         const int digits = static_cast<int>(random() % 4);
         for (int i = 0; i < 12; ++i) {
           s.rows.push_back({fmt::format("{:.3f}", 0.001 * i), number(random, digits, -2e3, 2e3),
                             number(random, digits, -90, 90)});
         }
         return s;
       },
       [](const std::filesystem::path& file) {
         const MeasuredRecord record = read_record(file);
         std::vector<double> all{record.rate};
         for (const double sample : record.samples.reshaped()) all.push_back(sample);
         return all;
       }}};
  return tables;
}

/// A way to write a table.
struct Form {
  const char* delimiter;
  bool has_decimal_commas;
};
const std::vector<Form> forms{{",", false}, {";", false}, {";", true}, {"\t", false}, {"\t", true}};
enum class Encoding { utf8, utf8_mark, utf16_little, utf16_big, windows };

bool is_number(const std::string& cell) {
  return cell.find_first_not_of("-.0123456789") == std::string::npos;
}

std::string text_of(const Specimen& s, const Form& form) {
  std::string text =
      "# L\xC3\xA4ufer, gemessen\n" + fmt::format("{}\n", fmt::join(s.head, form.delimiter));
  for (Cells row : s.rows) {
    for (std::string& cell : row) {
      if (form.has_decimal_commas && is_number(cell))
        std::replace(cell.begin(), cell.end(), '.', ',');
    }
    text += fmt::format("{}\n", fmt::join(row, form.delimiter));
  }
  return text;
}

std::string encoded(const std::string& text, Encoding as) {
  if (as == Encoding::utf8) return text;
  if (as == Encoding::utf8_mark) return "\xEF\xBB\xBF" + text;
  std::string units;  // the one letter beyond ASCII is U+00E4
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i] == '\xC3' ? '\xE4' : text[i];
    if (c == '\xE4') ++i;
    if (as == Encoding::windows) {
      units += c;
    } else {
      units += as == Encoding::utf16_little ? std::string{c, '\0'} : std::string{'\0', c};
    }
  }
  return (as == Encoding::utf16_little ? "\xFF\xFE"
          : as == Encoding::utf16_big  ? "\xFE\xFF"
                                       : "") +
         units;
}

/// A workbook with one sheet, texts in their cells.
void write_workbook(const std::filesystem::path& path, const Specimen& s) {
  std::string rows;
  const auto add = [&](const Cells& cells) {
    rows += "<row>";
    for (const std::string& cell : cells) {
      rows += is_number(cell) ? fmt::format("<c><v>{}</v></c>", cell)
                              : fmt::format("<c t=\"inlineStr\"><is><t>{}</t></is></c>", cell);
    }
    rows += "</row>";
  };
  add(s.head);
  for (const Cells& row : s.rows) add(row);
  const std::string spaces = "http://schemas.openxmlformats.org/";
  const std::vector<std::pair<std::string, std::string>> parts{
      {"_rels/.rels",
       fmt::format("<Relationships xmlns=\"{0}package/2006/relationships\"><Relationship Id=\"r1\" "
                   "Type=\"{0}officeDocument/2006/relationships/officeDocument\" "
                   "Target=\"xl/workbook.xml\"/></Relationships>",
                   spaces)},
      {"xl/workbook.xml",
       fmt::format("<workbook xmlns=\"{0}spreadsheetml/2006/main\" "
                   "xmlns:r=\"{0}officeDocument/2006/relationships\"><sheets><sheet name=\"A\" "
                   "sheetId=\"1\" r:id=\"r1\"/></sheets></workbook>",
                   spaces)},
      {"xl/_rels/workbook.xml.rels",
       fmt::format("<Relationships xmlns=\"{0}package/2006/relationships\"><Relationship Id=\"r1\" "
                   "Type=\"{0}officeDocument/2006/relationships/worksheet\" "
                   "Target=\"worksheets/sheet1.xml\"/></Relationships>",
                   spaces)},
      {"xl/worksheets/sheet1.xml",
       fmt::format("<worksheet xmlns=\"{}spreadsheetml/2006/main\"><sheetData>{}</sheetData>"
                   "</worksheet>",
                   spaces, rows)}};
  zipFile file = zipOpen(path.c_str(), APPEND_STATUS_CREATE);
  ASSERT_NE(file, nullptr);
  for (const auto& [name, text] : parts) {
    ASSERT_EQ(zipOpenNewFileInZip(file, name.c_str(), nullptr, nullptr, 0, nullptr, 0, nullptr,
                                  Z_DEFLATED, Z_DEFAULT_COMPRESSION),
              ZIP_OK);
    ASSERT_EQ(zipWriteInFileInZip(file, text.data(), static_cast<unsigned>(text.size())), ZIP_OK);
    ASSERT_EQ(zipCloseFileInZip(file), ZIP_OK);
  }
  ASSERT_EQ(zipClose(file, nullptr), ZIP_OK);
}

using TableForms = InResultFolder;

TEST_F(TableForms, AreReadTheSameOrRefused) {
  std::mt19937_64 random(37);
  for (const Kind& kind : kinds()) {
    int tried = 0, refused = 0;
    for (int round = 0; round < 8; ++round) {
      const Specimen specimen = kind.make(random);
      const auto book = folder / fmt::format("{}{}.xlsx", kind.name, round);
      write_workbook(book, specimen);
      const std::vector<double> right = kind.read(book);
      ASSERT_GE(right.size(), specimen.rows.size() * 2) << kind.name;
      for (const Form& form : forms) {
        for (const Encoding as : {Encoding::utf8, Encoding::utf8_mark, Encoding::utf16_little,
                                  Encoding::utf16_big, Encoding::windows}) {
          const std::string text = text_of(specimen, form);
          const auto file = folder / fmt::format("{}.csv", tried);
          std::ofstream(file, std::ios::binary) << encoded(text, as);
          ++tried;
          try {
            const std::vector<double> found = kind.read(file);
            ASSERT_EQ(found.size(), right.size()) << kind.name << "\n" << text;
            for (std::size_t i = 0; i < found.size(); ++i) {
              ASSERT_NEAR(found[i], right[i], 1e-12 * std::abs(right[i])) << kind.name << "\n"
                                                                          << text;
            }
          } catch (const ModelError& error) {
            ++refused;
            for (const Problem& problem : error.problems()) {
              EXPECT_TRUE(problem.where.line > 0 || !problem.key.empty())
                  << kind.name << ": " << problem.message << "\n"
                  << text;
            }
          }
        }
      }
    }
    EXPECT_LT(10 * refused, tried) << kind.name;  // what is ambiguous, as 1,250 alone
  }
}

}  // namespace table_forms_test
}  // namespace whirl::test
