// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/hdf5.h"

#include <algorithm>

#include "hooke/base/assert.h"
#include "hooke/io/failure.h"
#include "hooke/io/fletcher32.h"
#include "hooke/io/hdf5_driver.h"
#include "hooke/io/shuffle_deflate.h"

namespace hooke::io::hdf5 {

namespace {

constexpr unsigned kDeflateLevel = 1;

/// The name of the file that holds an object, for messages.
std::filesystem::path file_of(hid_t object) {
  char name[4096];
  const ssize_t length = H5Fget_name(object, name, sizeof name);
  return length > 0 ? std::filesystem::path(name) : std::filesystem::path();
}

[[noreturn]] void fail_at(hid_t object, const std::string& what) {
  if (const int error = read_error_of(object)) {
    throw Failure(Error::Kind::io, file_of(object), "can't be read: " + system_message(error));
  }
  throw Failure(Error::Kind::bad_input, file_of(object), "is damaged or not one of Hooke's: " + what);
}

/// Returns `id` if valid; otherwise throws Failure.
hid_t check(hid_t id, hid_t object, const std::string& what) {
  if (id < 0) fail_at(object, what);
  return id;
}

/// Whether a stored type is a whole number or a floating-point number of at most 64 bits, as `wanted` is.
bool is_number_like(hid_t stored, hid_t wanted) {
  return H5Tget_class(stored) == H5Tget_class(wanted) && H5Tget_size(stored) <= sizeof(std::uint64_t);
}

hsize_t file_bytes(hid_t object) {
  const Handle file(H5Iget_file_id(object));
  hsize_t bytes = 0;
  check(H5Fget_filesize(file.get(), &bytes), object, "it has no size");
  return bytes;
}

std::vector<H5Z_filter_t> filters_of(hid_t properties) {
  std::vector<H5Z_filter_t> filters;
  for (int i = 0; i < H5Pget_nfilters(properties); ++i) {
    std::size_t parameters = 0;
    filters.push_back(
        H5Pget_filter2(properties, static_cast<unsigned>(i), nullptr, &parameters, nullptr, 0, nullptr, nullptr));
  }
  return filters;
}

bool contains(const std::vector<H5Z_filter_t>& filters, H5Z_filter_t filter) {
  return std::find(filters.begin(), filters.end(), filter) != filters.end();
}

/// Whether the filters are among those that Hooke writes, which limits how much a stored byte can stand for.
bool are_known(const std::vector<H5Z_filter_t>& filters) {
  return std::all_of(filters.begin(), filters.end(), [](H5Z_filter_t filter) {
    return filter == H5Z_FILTER_SHUFFLE || filter == H5Z_FILTER_DEFLATE || filter == H5Z_FILTER_FLETCHER32;
  });
}

/// Whether all of a dataset's bytes lie in its own file.
bool is_self_contained(hid_t properties) {
  const H5D_layout_t layout = H5Pget_layout(properties);
  return (layout == H5D_CONTIGUOUS || layout == H5D_COMPACT || layout == H5D_CHUNKED) &&
         H5Pget_external_count(properties) == 0;
}

/// Whether a file of `bytes` can hold `count` rows of `row_bytes`: a damaged size must not take memory out of
/// proportion to the file.
bool can_hold(hsize_t bytes, hsize_t count, hsize_t row_bytes, bool compressed) {
  constexpr hsize_t kMostInflation = 1032;  // of deflate
  return count <= bytes * (compressed ? kMostInflation : 1) / row_bytes;
}

}  // namespace

void require(const std::filesystem::path&) {}

std::unique_lock<std::recursive_mutex> lock() {
  static std::recursive_mutex mutex;
  std::unique_lock<std::recursive_mutex> held(mutex);
  H5Eset_auto(H5E_DEFAULT, nullptr, nullptr);
  return held;
}

Handle::~Handle() {
  if (id_ < 0) return;
  switch (H5Iget_type(id_)) {
    case H5I_FILE:
      H5Fclose(id_);
      break;
    case H5I_GENPROP_LST:
      H5Pclose(id_);
      break;
    case H5I_ATTR:
      H5Aclose(id_);
      break;
    case H5I_DATASPACE:
      H5Sclose(id_);
      break;
    case H5I_DATATYPE:
      H5Tclose(id_);
      break;
    case H5I_BADID:
      break;  // already closed with its file
    default:
      H5Oclose(id_);
      break;
  }
}

File::File(const std::filesystem::path& path, JournaledFile::Mode mode)
    : bytes_(std::make_unique<JournaledFile>(path, mode)) {
  if (mode != JournaledFile::Mode::create && bytes_->size() == 0) {
    throw Failure(Error::Kind::bad_input, path, "is empty");
  }
  const Handle access = access_through(*bytes_);
  const std::string name = path.string();
  file_ = Handle(
      mode == JournaledFile::Mode::create
          ? H5Fcreate(name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get())
          : H5Fopen(name.c_str(), mode == JournaledFile::Mode::read ? H5F_ACC_RDONLY : H5F_ACC_RDWR, access.get()));
  if (file_.get() < 0) {
    check_reads();
    throw Failure(Error::Kind::bad_input, path, "is damaged, cut short, or no HDF5 file");
  }
  bytes_->allow_growth();
}

File::~File() {
  if (!bytes_) return;
  const auto held = lock();
  file_ = Handle();
}

void File::commit() {
  H5Fflush(file_.get(), H5F_SCOPE_GLOBAL);
  bytes_->commit();
}

void File::check_reads() const {
  if (const int error = bytes_->read_error()) {
    throw Failure(Error::Kind::io, bytes_->path(), "can't be read: " + system_message(error));
  }
}

void File::check_writes() const {
  if (const int error = bytes_->write_error()) {
    throw Failure(Error::Kind::io, bytes_->path(), "can't be written: " + system_message(error));
  }
}

void File::close() {
  file_ = Handle();
  check_writes();
}

template <>
hid_t memory_type<float>() {
  return H5T_NATIVE_FLOAT;
}
template <>
hid_t memory_type<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
hid_t memory_type<std::int64_t>() {
  return H5T_NATIVE_INT64;
}
template <>
hid_t memory_type<std::uint64_t>() {
  return H5T_NATIVE_UINT64;
}
template <>
hid_t memory_type<std::uint16_t>() {
  return H5T_NATIVE_UINT16;
}
template <>
hid_t memory_type<std::uint32_t>() {
  return H5T_NATIVE_UINT32;
}
template <>
hid_t memory_type<std::uint8_t>() {
  return H5T_NATIVE_UINT8;
}

template <>
hid_t file_type<float>() {
  return H5T_IEEE_F32LE;
}
template <>
hid_t file_type<double>() {
  return H5T_IEEE_F64LE;
}
template <>
hid_t file_type<std::int64_t>() {
  return H5T_STD_I64LE;
}
template <>
hid_t file_type<std::uint64_t>() {
  return H5T_STD_U64LE;
}
template <>
hid_t file_type<std::uint16_t>() {
  return H5T_STD_U16LE;
}
template <>
hid_t file_type<std::uint32_t>() {
  return H5T_STD_U32LE;
}
template <>
hid_t file_type<std::uint8_t>() {
  return H5T_STD_U8LE;
}

namespace {

/// Properties of what is created: no times of day, so that equal runs write equal files.
Handle without_times(hid_t kind) {
  Handle properties(H5Pcreate(kind));
  H5Pset_obj_track_times(properties.get(), false);
  return properties;
}

}  // namespace

Column Column::create(hid_t parent, const char* name, hid_t type, hsize_t width, hsize_t chunk_rows, bool compressed) {
  HOOKE_ASSERT(width > 0 && chunk_rows > 0, name, width, chunk_rows);
  const int rank = width == 1 ? 1 : 2;
  const hsize_t size[2] = {0, width};
  const hsize_t most[2] = {H5S_UNLIMITED, width};
  const hsize_t chunk[2] = {chunk_rows, width};
  const Handle properties = without_times(H5P_DATASET_CREATE);
  H5Pset_chunk(properties.get(), rank, chunk);
  if (compressed) {
    H5Pset_shuffle(properties.get());
    H5Pset_deflate(properties.get(), kDeflateLevel);
  }
  H5Pset_fletcher32(properties.get());
  const Handle space(H5Screate_simple(rank, size, most));
  Column column;
  column.dataset_ = Handle(H5Dcreate2(parent, name, type, space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT));
  check(column.dataset_.get(), parent, std::string("can't make ") + name);
  column.width_ = width;
  column.chunk_rows_ = chunk_rows;
  column.has_checksums_ = true;
  return column;
}

Column::Column(hid_t parent, const char* name, hid_t type, hsize_t width)
    : dataset_(H5Dopen2(parent, name, H5P_DEFAULT)),
      width_(width) {
  check(dataset_.get(), parent, std::string("it has no ") + name);
  const Handle space(H5Dget_space(dataset_.get()));
  const Handle stored(H5Dget_type(dataset_.get()));
  const Handle properties(H5Dget_create_plist(dataset_.get()));
  const std::vector<H5Z_filter_t> filters = filters_of(properties.get());
  const int rank = width == 1 ? 1 : 2;
  hsize_t size[2] = {0, 1};
  hsize_t chunk[2] = {0, 1};
  const bool good = is_number_like(stored.get(), type) && H5Sget_simple_extent_ndims(space.get()) == rank &&
                    H5Sget_simple_extent_dims(space.get(), size, nullptr) == rank &&
                    is_self_contained(properties.get()) && H5Pget_chunk(properties.get(), 2, chunk) == rank &&
                    chunk[0] > 0 && are_known(filters) && (rank == 1 || (size[1] == width && chunk[1] == width));
  if (!good) fail_at(parent, std::string(name) + " is no table of this kind");
  rows_ = size[0];
  chunk_rows_ = chunk[0];
  has_checksums_ = contains(filters, H5Z_FILTER_FLETCHER32);
  const bool compressed = contains(filters, H5Z_FILTER_DEFLATE);
  const hsize_t row_bytes = width * H5Tget_size(stored.get());
  if (rows_ > 0 && !can_hold(file_bytes(parent), std::max(rows_, chunk_rows_), row_bytes, compressed)) {
    fail_at(parent, std::string(name) + " is longer than its file");
  }
}

void Column::fail(const std::string& how) const { fail_at(dataset_.get(), how); }

void Column::resize(hsize_t rows) {
  const hsize_t size[2] = {rows, width_};
  if (H5Dset_extent(dataset_.get(), size) < 0) fail_at(dataset_.get(), "a table can't be resized");
  rows_ = rows;
}

namespace {

/// Calls `transfer` with the memory and file spaces of `count` rows from `start` on.
template <class Transfer>
void with_rows(hid_t dataset, hsize_t start, hsize_t count, hsize_t width, Transfer&& transfer) {
  if (count == 0) return;
  const hsize_t from[2] = {start, 0};
  const hsize_t size[2] = {count, width};
  const int rank = width == 1 ? 1 : 2;
  const Handle memory(H5Screate_simple(rank, size, nullptr));
  const Handle file(H5Dget_space(dataset));
  const bool good = H5Sselect_hyperslab(file.get(), H5S_SELECT_SET, from, nullptr, size, nullptr) >= 0 &&
                    H5Sselect_valid(file.get()) > 0 && transfer(memory.get(), file.get()) >= 0;
  if (!good) fail_at(dataset, "a table can't be read or written");
}

}  // namespace

void Column::write(hsize_t start, hsize_t count, hid_t type, const void* data) {
  HOOKE_ASSERT(start + count <= rows_, start, count, rows_);
  with_rows(dataset_.get(), start, count, width_,
            [&](hid_t memory, hid_t file) { return H5Dwrite(dataset_.get(), type, memory, file, H5P_DEFAULT, data); });
}

void Column::read(hsize_t start, hsize_t count, hid_t type, void* data) const {
  if (start > rows_ || count > rows_ - start) fail("a table is shorter than another one says");
  with_rows(dataset_.get(), start, count, width_,
            [&](hid_t memory, hid_t file) { return H5Dread(dataset_.get(), type, memory, file, H5P_DEFAULT, data); });
}

hsize_t Column::next_chunk(hsize_t rows) const { return (rows + chunk_rows_ - 1) / chunk_rows_ * chunk_rows_; }

template <class Real>
void Column::append_chunks(const Real* values, hsize_t count) {
  const hsize_t first = next_chunk(rows_);
  resize(next_chunk(first + count));
  std::vector<Real> last;  // padded with zeros
  for (hsize_t start = 0; start < count; start += chunk_rows_) {
    const Real* chunk = values + start * width_;
    if (count - start < chunk_rows_) {
      last.assign(chunk, values + count * width_);
      last.resize(chunk_rows_ * width_);
      chunk = last.data();
    }
    std::string bytes = shuffle_deflate(chunk, chunk_rows_ * width_, sizeof(Real));
    if (has_checksums_) append_fletcher32(bytes);
    const hsize_t at[2] = {first + start, 0};
    if (H5Dwrite_chunk(dataset_.get(), H5P_DEFAULT, 0, at, bytes.size(), bytes.data()) < 0) {
      fail("a table can't be written");
    }
  }
}

template void Column::append_chunks(const float*, hsize_t);
template void Column::append_chunks(const double*, hsize_t);

Handle create_group(hid_t parent, const char* name) {
  return Handle(check(H5Gcreate2(parent, name, H5P_DEFAULT, without_times(H5P_GROUP_CREATE).get(), H5P_DEFAULT), parent,
                      std::string("can't make ") + name));
}

Handle open_group(hid_t parent, const char* name) {
  return Handle(check(H5Gopen2(parent, name, H5P_DEFAULT), parent, std::string("it has no ") + name));
}

void remove(hid_t parent, const char* name) {
  if (H5Ldelete(parent, name, H5P_DEFAULT) < 0) fail_at(parent, std::string("can't remove ") + name);
}

bool exists(hid_t parent, const char* name) {
  const htri_t found = H5Lexists(parent, name, H5P_DEFAULT);
  if (found < 0) fail_at(parent, std::string("whether it has ") + name + " can't be told");
  return found > 0;
}

void write_integer_attribute(hid_t object, const char* name, const std::vector<std::int64_t>& values, bool scalar) {
  const hsize_t size = values.size();
  const Handle space(scalar ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &size, nullptr));
  const Handle attribute(H5Acreate2(object, name, H5T_STD_I64LE, space.get(), H5P_DEFAULT, H5P_DEFAULT));
  if (attribute.get() < 0 || H5Awrite(attribute.get(), H5T_NATIVE_INT64, values.data()) < 0) {
    fail_at(object, std::string("can't make ") + name);
  }
}

void write_text_attribute(hid_t object, const char* name, const std::string& text) {
  const Handle type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type.get(), text.size());
  H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
  const Handle space(H5Screate(H5S_SCALAR));
  const Handle attribute(H5Acreate2(object, name, type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT));
  const bool good = attribute.get() >= 0 && H5Awrite(attribute.get(), type.get(), text.data()) >= 0;
  if (!good) fail_at(object, std::string("can't make ") + name);
}

namespace {

/// Opens an attribute that is one whole number.
Handle open_integer_attribute(hid_t object, const char* name) {
  Handle attribute(check(H5Aopen(object, name, H5P_DEFAULT), object, std::string("it has no ") + name));
  const Handle space(H5Aget_space(attribute.get()));
  const Handle stored(H5Aget_type(attribute.get()));
  if (H5Sget_simple_extent_npoints(space.get()) != 1 || !is_number_like(stored.get(), memory_type<std::int64_t>())) {
    fail_at(object, std::string(name) + " is no number");
  }
  return attribute;
}

}  // namespace

std::int64_t read_integer_attribute(hid_t object, const char* name) {
  const Handle attribute = open_integer_attribute(object, name);
  std::int64_t value = 0;
  if (H5Aread(attribute.get(), H5T_NATIVE_INT64, &value) < 0) fail_at(object, std::string(name) + " is no number");
  return value;
}

void set_integer_attribute(hid_t object, const char* name, std::int64_t value) {
  const Handle attribute = open_integer_attribute(object, name);
  if (H5Awrite(attribute.get(), H5T_NATIVE_INT64, &value) < 0) fail_at(object, std::string("can't set ") + name);
}

void write_text(hid_t parent, const char* name, const std::string& text) {
  const Handle type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type.get(), std::max<std::size_t>(text.size(), 1));
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
  const Handle space(H5Screate(H5S_SCALAR));
  const Handle properties = without_times(H5P_DATASET_CREATE);
  const Handle dataset(H5Dcreate2(parent, name, type.get(), space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT));
  const bool good =
      dataset.get() >= 0 && H5Dwrite(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()) >= 0;
  if (!good) fail_at(parent, std::string("can't make ") + name);
}

std::string read_text(hid_t parent, const char* name) {
  const Handle dataset(check(H5Dopen2(parent, name, H5P_DEFAULT), parent, std::string("it has no ") + name));
  const Handle type(H5Dget_type(dataset.get()));
  const Handle space(H5Dget_space(dataset.get()));
  const Handle properties(H5Dget_create_plist(dataset.get()));
  const bool fixed = H5Tget_class(type.get()) == H5T_STRING && H5Tis_variable_str(type.get()) == 0;
  const std::size_t size = fixed ? H5Tget_size(type.get()) : 0;
  if (!fixed || H5Sget_simple_extent_npoints(space.get()) != 1 || !is_self_contained(properties.get()) ||
      size > file_bytes(parent)) {
    fail_at(parent, std::string(name) + " is no text");
  }
  std::string text(size, '\0');
  if (H5Dread(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) < 0) {
    fail_at(parent, std::string(name) + " can't be read");
  }
  text.resize(std::min(text.find('\0'), text.size()));
  return text;
}

Array::Array(hid_t parent, const char* name, hid_t type, hsize_t rows, hsize_t width) : rows_(rows), width_(width) {
  const hsize_t size[2] = {rows, width};
  const Handle space(H5Screate_simple(width == 1 ? 1 : 2, size, nullptr));
  const Handle properties = without_times(H5P_DATASET_CREATE);
  dataset_ = Handle(check(H5Dcreate2(parent, name, type, space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT),
                          parent, std::string("can't make ") + name));
}

void Array::append(hid_t type, const void* values, hsize_t count) {
  HOOKE_ASSERT(count <= rows_ - written_, count, rows_, written_);
  with_rows(dataset_.get(), written_, count, width_, [&](hid_t memory, hid_t file) {
    return H5Dwrite(dataset_.get(), type, memory, file, H5P_DEFAULT, values);
  });
  written_ += count;
}

template <class T>
void write_array(hid_t parent, const char* name, const T* values, hsize_t rows, hsize_t width) {
  Array::create<T>(parent, name, rows, width).append(values, rows);
}

template <class T>
ArrayRows<T>::ArrayRows(hid_t parent, const char* name, hsize_t width)
    : name_(name),
      dataset_(check(H5Dopen2(parent, name, H5P_DEFAULT), parent, std::string("it has no ") + name)),
      width_(width) {
  const Handle space(H5Dget_space(dataset_.get()));
  const Handle stored(H5Dget_type(dataset_.get()));
  const Handle properties(H5Dget_create_plist(dataset_.get()));
  const int rank = width == 1 ? 1 : 2;
  hsize_t size[2] = {0, 1};
  const bool good = H5Tequal(stored.get(), file_type<T>()) > 0 && is_self_contained(properties.get()) &&
                    H5Sget_simple_extent_ndims(space.get()) == rank &&
                    H5Sget_simple_extent_dims(space.get(), size, nullptr) == rank && (rank == 1 || size[1] == width);
  // A damaged size must not make us allocate more memory than the file could fill.
  if (!good || size[0] > file_bytes(parent) / sizeof(T) / width) {
    fail_at(parent, std::string(name) + " is no table of this kind");
  }
  rows_ = size[0];
}

template <class T>
void ArrayRows<T>::read(hsize_t start, hsize_t count, T* values) const {
  HOOKE_ASSERT(start <= rows_ && count <= rows_ - start, start, count, rows_);
  with_rows(dataset_.get(), start, count, width_, [&](hid_t memory, hid_t file) {
    const herr_t status = H5Dread(dataset_.get(), memory_type<T>(), memory, file, H5P_DEFAULT, values);
    if (status < 0) fail_at(dataset_.get(), name_ + " can't be read");
    return status;
  });
}

template <class T>
std::vector<T> read_array(hid_t parent, const char* name, hsize_t width) {
  const ArrayRows<T> array(parent, name, width);
  std::vector<T> values(array.rows() * width);
  array.read(0, array.rows(), values.data());
  return values;
}

template void write_array(hid_t, const char*, const double*, hsize_t, hsize_t);
template void write_array(hid_t, const char*, const std::uint64_t*, hsize_t, hsize_t);
template void write_array(hid_t, const char*, const std::uint16_t*, hsize_t, hsize_t);
template void write_array(hid_t, const char*, const std::uint32_t*, hsize_t, hsize_t);
template void write_array(hid_t, const char*, const std::uint8_t*, hsize_t, hsize_t);
template class ArrayRows<double>;
template class ArrayRows<std::uint64_t>;
template class ArrayRows<std::uint16_t>;
template std::vector<double> read_array(hid_t, const char*, hsize_t);
template std::vector<std::uint64_t> read_array(hid_t, const char*, hsize_t);
template std::vector<std::uint16_t> read_array(hid_t, const char*, hsize_t);
template std::vector<std::uint32_t> read_array(hid_t, const char*, hsize_t);
template std::vector<std::uint8_t> read_array(hid_t, const char*, hsize_t);

}  // namespace hooke::io::hdf5
