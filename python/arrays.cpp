// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "arrays.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

namespace hooke::python {
namespace {

constexpr char kReal[] = "fiu", kWhole[] = "iu";

std::string shape_text(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t k = 0; k < array.ndim(); ++k) text += fmt::format("{}{}", k > 0 ? ", " : "", array.shape(k));
  return text + (array.ndim() == 1 ? ",)" : ")");
}

// The value as an array whose numbers are of one of these kinds of numpy's.
py::array of_kind(const py::object& value, const char* kinds, const std::string& name, const std::string& wanted) {
  const py::array array = py::array::ensure(value);
  if (!array) {
    PyErr_Clear();
    raise_input(name, fmt::format("expected {}, got {}", wanted, Py_TYPE(value.ptr())->tp_name));
  }
  if (array.size() > 0 && std::strchr(kinds, array.dtype().kind()) == nullptr) {
    raise_input(name, fmt::format("expected {}, got {} of shape {}", wanted, py::str(array.dtype()).cast<std::string>(),
                                  shape_text(array)));
  }
  return array;
}

std::vector<Vec3d> rows(const py::object& value, std::optional<std::size_t> count, const std::string& name) {
  const std::string wanted =
      count ? fmt::format("numbers of shape ({}, 3) or (3,)", *count) : std::string("numbers of shape (n, 3)");
  const py::array array = of_kind(value, kReal, name, wanted);
  const bool one = array.ndim() == 1 && array.shape(0) == 3 && count;
  const bool many =
      array.ndim() == 2 && array.shape(1) == 3 && (!count || array.shape(0) == static_cast<py::ssize_t>(*count));
  const bool none = array.size() == 0 && array.ndim() == 1 && count.value_or(0) == 0;  // an empty list
  if (!one && !many && !none) raise_input(name, fmt::format("expected {}, got shape {}", wanted, shape_text(array)));
  if (none) return {};
  const auto numbers = py::array_t < double, py::array::c_style | py::array::forcecast > ::ensure(array);
  if (!numbers) throw py::error_already_set();
  std::vector<Vec3d> vectors(count.value_or(static_cast<std::size_t>(array.shape(0))));
  const double* from = numbers.data();
  for (std::size_t i = 0; i < vectors.size(); ++i, from += one ? 0 : 3) {
    vectors[i] = {from[0], from[1], from[2]};
    if (std::isfinite(from[0]) && std::isfinite(from[1]) && std::isfinite(from[2])) continue;
    raise_input(name, fmt::format("row {} is ({}, {}, {}): numbers must be finite", i, from[0], from[1], from[2]));
  }
  return vectors;
}

}  // namespace

std::vector<Vec3d> to_vectors(const py::object& value, std::size_t count, const std::string& name) {
  return rows(value, count, name);
}

std::vector<Vec3d> to_vectors(const py::object& value, const std::string& name) { return rows(value, {}, name); }

Vec3d to_vector(const py::object& value, const std::string& name) {
  const py::array array = of_kind(value, kReal, name, "three numbers");
  if (array.ndim() != 1 || array.shape(0) != 3) {
    raise_input(name, fmt::format("expected three numbers, got shape {}", shape_text(array)));
  }
  return rows(value, 1, name).front();
}

std::vector<std::uint64_t> to_ids(const py::object& value, const std::string& name) {
  const std::string wanted = "an id or ids of shape (n,), whole numbers";
  const py::array array = of_kind(value, kWhole, name, wanted);
  if (array.ndim() > 1) raise_input(name, fmt::format("expected {}, got shape {}", wanted, shape_text(array)));
  if (array.size() == 0) return {};
  if (array.dtype().kind() == 'i') {
    const auto numbers = py::array_t < std::int64_t, py::array::c_style | py::array::forcecast > ::ensure(array);
    const auto negative = std::find_if(numbers.data(), numbers.data() + numbers.size(), [](auto id) { return id < 0; });
    if (negative != numbers.data() + numbers.size()) raise_input(name, fmt::format("{} is no id: below 0", *negative));
  }
  const auto numbers = py::array_t < std::uint64_t, py::array::c_style | py::array::forcecast > ::ensure(array);
  if (!numbers) throw py::error_already_set();
  return {numbers.data(), numbers.data() + numbers.size()};
}

py::array to_array(const Vec3d& vector) { return py::array_t<double>(3, &vector.x); }

py::array to_array(const std::vector<Vec3d>& vectors) {
  py::array_t<double> array({static_cast<py::ssize_t>(vectors.size()), py::ssize_t{3}});
  if (!vectors.empty()) std::memcpy(array.mutable_data(), vectors.data(), vectors.size() * sizeof(Vec3d));
  return array;
}

}  // namespace hooke::python
