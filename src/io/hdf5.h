// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hooke/base/assert.h"
#include "hooke/base/vec3.h"
#include "hooke/io/hdf5_library.h"
#include "hooke/io/journaled_file.h"

// The part of HDF5's C interface that this library needs. All functions throw Failure. Callers hold hdf5::lock()
// throughout: a run's writer has its own thread, and HDF5 may be built without thread safety (Debian's is).
namespace hooke::io::hdf5 {

/// An HDF5 identifier of any kind; closes itself.
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

/// An HDF5 file whose bytes go through a JournaledFile, so that a failed write never disturbs the library: only
/// commit() or close() reports it.
class File {
 public:
  File(const std::filesystem::path& path, JournaledFile::Mode mode);
  ~File();
  File(File&&) noexcept = default;
  File& operator=(File&&) noexcept = default;

  hid_t id() const { return file_.get(); }
  JournaledFile& bytes() const { return *bytes_; }

  /// Makes everything written so far the committed state.
  void commit();
  /// Throws the error of the first read, or write, that failed, if one did.
  void check_reads() const;
  void check_writes() const;
  /// Flushes and closes; for files written without a commit. Throws the first write error, if there was one.
  void close();

 private:
  std::unique_ptr<JournaledFile> bytes_;  // outlives the HDF5 file
  Handle file_;
};

/// HDF5's type of a number in memory, and in files (the same type, little endian).
template <class T>
hid_t memory_type();
template <class T>
hid_t file_type();

/// Rows of `width` numbers that can grow and shrink: a chunked dataset.
class Column {
 public:
  Column() = default;
  /// Opens an existing dataset of whole numbers, or of floating-point numbers, as `type` is one or the other.
  Column(hid_t parent, const char* name, hid_t type, hsize_t width);
  /// Creates a dataset without rows. width 1 makes it one-dimensional. Compressed datasets are shuffled and deflated.
  /// Each chunk bears a checksum, HDF5's Fletcher-32: reading a damaged one fails.
  static Column create(hid_t parent, const char* name, hid_t type, hsize_t width, hsize_t chunk_rows, bool compressed);

  hsize_t rows() const { return rows_; }
  hsize_t chunk_rows() const { return chunk_rows_; }
  /// The first row at or after `rows` that starts a chunk.
  hsize_t next_chunk(hsize_t rows) const;
  void resize(hsize_t rows);

  /// `count` rows from `start` on, within rows(). Reading throws a Failure where there are fewer.
  void write(hsize_t start, hsize_t count, hid_t type, const void* data);
  void read(hsize_t start, hsize_t count, hid_t type, void* data) const;

  /// Appends rows of floating-point numbers from the next chunk on, compressed by shuffle_deflate. For columns created
  /// as compressed.
  template <class Real>
  void append_chunks(const Real* values, hsize_t count);

  /// Throws a Failure that says how this table's file is damaged.
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
  bool has_checksums_ = false;  // a column of a file from before chunks had them has none
};

Handle create_group(hid_t parent, const char* name);
Handle open_group(hid_t parent, const char* name);
bool exists(hid_t parent, const char* name);  ///< throws where that can't be read
void remove(hid_t parent, const char* name);

/// Scalar or short vector attributes: 64-bit whole numbers or doubles.
void write_integer_attribute(hid_t object, const char* name, const std::vector<std::int64_t>& values,
                             bool scalar = false);
void write_text_attribute(hid_t object, const char* name, const std::string& text);
std::int64_t read_integer_attribute(hid_t object, const char* name);
void set_integer_attribute(hid_t object, const char* name, std::int64_t value);

/// A single text: a scalar dataset of fixed length.
void write_text(hid_t parent, const char* name, const std::string& text);
std::string read_text(hid_t parent, const char* name);

/// A new array, contiguous and uncompressed: rows of `width` numbers, which are written from the first on.
class Array {
 public:
  template <class T>
  static Array create(hid_t parent, const char* name, hsize_t rows, hsize_t width = 1) {
    return Array(parent, name, file_type<T>(), rows, width);
  }
  template <class T>
  void append(const T* values, hsize_t count) {
    append(memory_type<T>(), values, count);
  }

 private:
  Array(hid_t parent, const char* name, hid_t type, hsize_t rows, hsize_t width);
  void append(hid_t type, const void* values, hsize_t count);

  Handle dataset_;
  hsize_t rows_, width_;
  hsize_t written_ = 0;
};

/// A whole array of this kind.
template <class T>
void write_array(hid_t parent, const char* name, const T* values, hsize_t rows, hsize_t width = 1);
template <class T>
std::vector<T> read_array(hid_t parent, const char* name, hsize_t width = 1);

/// An array of write_array(), to be read some rows at a time.
template <class T>
class ArrayRows {
 public:
  ArrayRows(hid_t parent, const char* name, hsize_t width = 1);
  hsize_t rows() const { return rows_; }
  /// `count` rows from `start` on, within rows().
  void read(hsize_t start, hsize_t count, T* values) const;

 private:
  std::string name_;
  Handle dataset_;
  hsize_t rows_ = 0;
  hsize_t width_ = 1;
};

}  // namespace hooke::io::hdf5
