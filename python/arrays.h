// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/numpy.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "errors.h"
#include "hooke/base/vec3.h"

namespace hooke::python {

/// Vectors from an array of shape (count, 3), or from one of shape (3,), which stands for all. InputError, which calls
/// it `name`, where the shape or the type is another or a number is not finite.
std::vector<Vec3d> to_vectors(const py::object& value, std::size_t count, const std::string& name);
/// The same for an array of any number of rows.
std::vector<Vec3d> to_vectors(const py::object& value, const std::string& name);
Vec3d to_vector(const py::object& value, const std::string& name);

/// Ids from a whole number or from an array of shape (n,) of them; InputError otherwise.
std::vector<std::uint64_t> to_ids(const py::object& value, const std::string& name = "ids");

/// A copy, of shape (3,) or (n, 3).
py::array to_array(const Vec3d& vector);
py::array to_array(const std::vector<Vec3d>& vectors);

template <class T>
py::array to_array(const std::vector<T>& values) {
  return py::array_t<T>(static_cast<py::ssize_t>(values.size()), values.data());
}

/// A read-only array of memory that `owner` keeps alive, without a copy.
template <class Owner>
py::array view(const std::shared_ptr<Owner>& owner, const py::dtype& type, std::vector<py::ssize_t> shape,
               std::vector<py::ssize_t> strides, const void* data) {
  const py::capsule keep(new std::shared_ptr<Owner>(owner),
                         [](void* kept) { delete static_cast<std::shared_ptr<Owner>*>(kept); });
  py::array array(type, std::move(shape), std::move(strides), data, keep);
  array.attr("flags").attr("writeable") = false;
  return array;
}

static_assert(sizeof(Vec3d) == 3 * sizeof(double), "columns are read as (n, 3)");

}  // namespace hooke::python
