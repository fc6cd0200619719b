// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "hooke/base/assert.h"
#include "hooke/base/vec3.h"
#include "hooke/io/journaled_file.h"

// What this library needs of HDF5's C interface. Everything throws Failure; callers hold hdf5::lock() throughout: a
// run's writer has a thread of its own, and a build of HDF5 need not be one that several threads may use (Debian's is).
namespace hooke::hdf5 {

/// Sole use of the HDF5 library until it goes out of scope; turns off the library's own printing of errors.
[[nodiscard]] std::unique_lock<std::recursive_mutex> lock();

/// An HDF5 identifier of any kind that closes itself.
class Handle {
 public:
  Handle() = default;
  explicit Handle(hid_t id) : id_(id) {}
  ~Handle();
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  hid_t get() const { return id_; }

 private:
  hid_t id_ = H5I_INVALID_HID;
};

/// An HDF5 file whose bytes go through a JournaledFile, so that a failed write never makes the library stumble: it
/// shows in commit() or close() alone.
class File {
 public:
  File(const std::filesystem::path& path, JournaledFile::Mode mode);
  ~File();
  File(File&&) noexcept = default;
  File& operator=(File&&) noexcept = default;

  hid_t id() const { return file_.get(); }
  JournaledFile& bytes() { return *bytes_; }

  /// Everything written so far becomes the committed state.
  void commit();
  /// Throws the error of the first write that failed, if one did.
  void check_writes() const;
  /// Flushes and closes; for files that were written without a commit. The last error, if there was one.
  void close();

 private:
  std::unique_ptr<JournaledFile> bytes_;  // outlives the HDF5 file
  Handle file_;
};

/// HDF5's type of a number in memory, and in files (the same, little endian).
template <class T>
hid_t memory_type();
template <class T>
hid_t file_type();

/// Rows of `width` numbers that can grow and shrink: a chunked dataset.
class Column {
 public:
  Column() = default;
  Column(hid_t parent, const char* name, hsize_t width);  ///< one that is there
  /// A new one without rows. width 1 makes it one-dimensional. Compressed ones are shuffled and deflated.
  static Column create(hid_t parent, const char* name, hid_t type, hsize_t width, hsize_t chunk_rows, bool compressed);

  hsize_t rows() const { return rows_; }
  /// The first row at or behind `rows` that starts a chunk.
  hsize_t next_chunk(hsize_t rows) const;
  void resize(hsize_t rows);

  /// `count` rows from `start` on, within rows(). Of what is to be read a damaged file may hold less: a Failure.
  void write(hsize_t start, hsize_t count, hid_t type, const void* data);
  void read(hsize_t start, hsize_t count, hid_t type, void* data) const;

  /// Appends rows of floating-point numbers at the next whole chunk, compressed by shuffle_deflate; returns where they
  /// start. For columns that were made compressed.
  template <class Real>
  hsize_t append_chunks(const Real* values, hsize_t count);

  /// Throws the Failure that this table's file is damaged, and how.
  [[noreturn]] void fail(const std::string& how) const;

  template <class T>
  void append(const std::vector<T>& values) {
    HOOKE_ASSERT(values.size() % width_ == 0, values.size(), width_);
    const hsize_t start = rows_;
    const hsize_t count = values.size() / width_;
    resize(start + count);
    write(start, count, memory_type<T>(), values.data());
  }
  template <class T>
  std::vector<T> read_all() const {
    std::vector<T> values(rows_ * width_);
    read(0, rows_, memory_type<T>(), values.data());
    return values;
  }

 private:
  Handle dataset_;
  hsize_t rows_ = 0;
  hsize_t width_ = 1;
  hsize_t chunk_rows_ = 0;
};

Handle create_group(hid_t parent, const char* name);
Handle open_group(hid_t parent, const char* name);
bool exists(hid_t parent, const char* name);
void remove(hid_t parent, const char* name);

/// Scalar or short vector attributes, 64-bit whole numbers or doubles.
void write_integer_attribute(hid_t object, const char* name, const std::vector<std::int64_t>& values,
                             bool scalar = false);
void write_text_attribute(hid_t object, const char* name, const std::string& text);
std::int64_t read_integer_attribute(hid_t object, const char* name);
void set_integer_attribute(hid_t object, const char* name, std::int64_t value);

/// One text, a scalar dataset of fixed length.
void write_text(hid_t parent, const char* name, const std::string& text);
std::string read_text(hid_t parent, const char* name);

/// A whole array in one piece, not compressed: rows of `width` numbers.
template <class T>
void write_array(hid_t parent, const char* name, const T* values, hsize_t rows, hsize_t width = 1);
template <class T>
std::vector<T> read_array(hid_t parent, const char* name, hsize_t width = 1);

}  // namespace hooke::hdf5
