// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "errors.h"

namespace hooke::python {
namespace {

py::object errors_attribute(const char* name) { return py::module_::import("hooke._errors").attr(name); }

const char* class_name(ErrorClass type) {
  switch (type) {
    case ErrorClass::scene:
      return "SceneError";
    case ErrorClass::input:
      return "InputError";
    case ErrorClass::run_failed:
      return "RunFailed";
    case ErrorClass::file:
      return "FileError";
    case ErrorClass::busy:
      return "BusyError";
    case ErrorClass::closed:
      return "ClosedError";
  }
  return "Error";
}

}  // namespace

py::list to_list(const std::vector<Finding>& findings) {
  const py::object make = errors_attribute("Finding");
  py::list list;
  for (const Finding& finding : findings) {
    // A finding may quote a file whose bytes are no text.
    const auto text = [](const std::string& bytes) {
      return py::reinterpret_steal<py::object>(
          PyUnicode_DecodeUTF8(bytes.data(), static_cast<py::ssize_t>(bytes.size()), "replace"));
    };
    list.append(make(text(finding.where), text(finding.message)));
  }
  return list;
}

void raise(ErrorClass type, const std::vector<Finding>& findings) {
  const py::object exception_class = errors_attribute(class_name(type));
  const py::object exception = exception_class(to_list(findings));
  PyErr_SetObject(exception_class.ptr(), exception.ptr());
  throw py::error_already_set();
}

void raise(const Error& error, ErrorClass bad_input) {
  switch (error.kind) {
    case Error::Kind::bad_input:
      raise(bad_input, error.findings);
    case Error::Kind::run_failed:
      raise(ErrorClass::run_failed, error.findings);
    case Error::Kind::io:
      break;
  }
  raise(ErrorClass::file, error.findings);
}

}  // namespace hooke::python
