// The module whirl._whirl: what the package is made of.

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "libio/import/import_file.hpp"
#include "libio/model/file_text.hpp"
#include "libio/model/model_schema.hpp"
#include "libio/model/model_table.hpp"
#include "libverbs/command/version.hpp"
#include "python/module/call.hpp"
#include "python/module/errors.hpp"
#include "python/module/model_text.hpp"
#include "python/module/pictures.hpp"
#include "python/module/store.hpp"

namespace py = pybind11;
using namespace whirl;

PYBIND11_MODULE(_whirl, module) {
  module.doc() = "The libraries of whirl, for the package whirl.";
  module.attr("version") = version;
  translate_errors();

  py::class_<ModelText>(module, "ModelText")
      .def(py::init<std::string, std::string, std::vector<std::string>, bool>(), py::arg("file"),
           py::arg("text"), py::arg("sets"), py::arg("stored") = false)
      .def("with_sets", &ModelText::with, py::arg("sets"))
      .def("value", &ModelText::value, py::arg("path"))
      .def("matrices", &ModelText::matrices)
      .def_property_readonly("file", &ModelText::file)
      .def_property_readonly("text", &ModelText::text)
      .def_property_readonly("sets", &ModelText::sets)
      .def_property_readonly("source", [](const ModelText& m) { return m.made()->source; })
      .def_property_readonly("title", [](const ModelText& m) { return m.made()->title; })
      .def_property_readonly("speed", [](const ModelText& m) { return m.made()->speed; });

  py::class_<Store>(module, "Store")
      .def(py::init<const std::string&>(), py::arg("file"))
      .def("paths", &Store::paths)
      .def("info", &Store::info, py::arg("path"))
      .def("values", &Store::values, py::arg("path"))
      .def("attributes", &Store::attributes)
      .def("save", &Store::save, py::arg("file"), py::arg("force"));

  py::class_<Found>(module, "Found")
      .def_property_readonly("json", [](const Found& f) { return f.report.record.json(); })
      .def_property_readonly("text", [](const Found& f) { return shown_text(f.report.text); })
      .def_property_readonly("notes", [](const Found& f) { return f.report.notes; })
      .def_property_readonly(
          "failure", [](const Found& f) { return f.report.failure ? f.report.failure.text() : ""; })
      .def_property_readonly("status", [](const Found& f) { return f.report.status; })
      .def_readonly("seconds", &Found::seconds)
      .def("store", [](const Found& f) { return Store(f.kept); });

  py::class_<Drawn>(module, "Drawn")
      .def(py::init<const std::string&>(), py::arg("file"))
      .def("kinds", &Drawn::kinds)
      .def("svg", &Drawn::svg, py::arg("kind"), py::arg("variant"))
      .def("figure", &Drawn::figure, py::arg("kind"), py::arg("variant"));

  module.def("model_schema", [] { return model_schema().json(); });
  module.def("model_tables", [] {  // names, and whether there is one, several, or one of each name
    py::list tables;
    for (const ModelTable& table : model_tables()) {
      tables.append(py::make_tuple(table.name, name_of(table.form)));
    }
    return tables;
  });
  module.def("file_text", [](const std::string& path) { return file_text(path); });
  module.def("import_file", [](const std::string& file, const std::string& place) {
    const Imported made = import_file(file, place, Replaces::own_pictures);
    return py::make_tuple(made.left_out, made.taken_differently);
  });
  module.def("verb_table", &verb_table);
  module.def(
      "run",
      [](const std::string& verb, const ModelText& model, const GivenValues& given,
         const py::object& progress, const std::string& motion,
         const std::vector<std::string>& sets_before) {
        return run_verb(verb, {.model = &model, .motion = motion, .sets_before = sets_before},
                        given, progress);
      },
      py::arg("verb"), py::arg("model"), py::arg("given"), py::arg("progress"),
      py::arg("motion") = "", py::arg("sets_before") = std::vector<std::string>{});
  module.def(
      "run_on_file",
      [](const std::string& verb, const std::string& file, const GivenValues& given,
         const py::object& progress) { return run_verb(verb, {.file = file}, given, progress); },
      py::arg("verb"), py::arg("file"), py::arg("given"), py::arg("progress"));
  module.def("report_html", &report_html, py::arg("files"));
}
