#include "python/module/errors.hpp"

#include <pybind11/pybind11.h>

#include <exception>

#include "libbase/error.hpp"
#include "libio/results/replace_file.hpp"
#include "libio/text/terminal.hpp"

namespace whirl::inline python {

namespace py = pybind11;

namespace {

void raise(const char* name, const py::object& value) {
  const py::object type = py::module_::import("whirl.errors").attr(name);
  PyErr_SetObject(type.ptr(), type(value).ptr());
}

void raise_text(const char* name, const std::exception& error) {
  raise(name, py::str(shown_text(error.what())));
}

py::list list_of(const std::vector<Problem>& problems) {
  const py::object type = py::module_::import("whirl.errors").attr("Problem");
  py::list list;
  for (const Problem& p : problems) {
    list.append(type(p.where.file, p.where.line, p.where.column, p.key, p.message));
  }
  return list;
}

}  // namespace

void translate_errors() {
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(pointer);
    } catch (const ModelError& error) {
      raise("ModelError", list_of(error.problems()));
    } catch (const NumericalError& error) {
      raise_text("NumericalError", error);
    } catch (const FileError& error) {
      raise_text("FileError", error);
    }
  });
}

}  // namespace whirl::inline python
