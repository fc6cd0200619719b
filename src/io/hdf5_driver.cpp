// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/hdf5_driver.h"

#include <cstddef>

#include "hooke/io/failure.h"

namespace hooke::io::hdf5 {

namespace {

/// The file object that HDF5 passes to each call; HDF5's own part comes first.
struct DriverFile {
  H5FD_t base;
  JournaledFile* bytes;
};

JournaledFile& bytes_of(H5FD_t* file) { return *reinterpret_cast<DriverFile*>(file)->bytes; }
const JournaledFile& bytes_of(const H5FD_t* file) { return *reinterpret_cast<const DriverFile*>(file)->bytes; }

/// The data of the file access properties; HDF5 copies it byte by byte.
struct DriverInfo {
  JournaledFile* bytes;
};

H5FD_t* open_file(const char*, unsigned, hid_t access, haddr_t) {
  const auto* info = static_cast<const DriverInfo*>(H5Pget_driver_info(access));
  if (info == nullptr) return nullptr;
  auto* file = new (std::nothrow) DriverFile{};
  if (file == nullptr) return nullptr;
  file->bytes = info->bytes;
  return &file->base;
}

herr_t close_file(H5FD_t* file) {
  delete reinterpret_cast<DriverFile*>(file);
  return 0;
}

herr_t query(const H5FD_t*, unsigned long* flags) {
  if (flags != nullptr) {
    *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
             H5FD_FEAT_AGGREGATE_SMALLDATA;
  }
  return 0;
}

haddr_t get_eoa(const H5FD_t* file, H5FD_mem_t) { return bytes_of(file).end(); }
haddr_t get_eof(const H5FD_t* file, H5FD_mem_t) { return bytes_of(file).size(); }

// While it opens a file, HDF5 takes memory for whatever a damaged file claims to have behind its end.
herr_t set_eoa(H5FD_t* file, H5FD_mem_t, haddr_t end) {
  JournaledFile& bytes = bytes_of(file);
  if (!bytes.may_grow() && end > bytes.size()) return -1;
  bytes.set_end(end);
  return 0;
}

herr_t read_bytes(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t offset, std::size_t size, void* data) {
  return bytes_of(file).read(offset, data, size) == 0 ? 0 : -1;
}

// Always succeeds: JournaledFile remembers the error, and File reports it when the caller can react.
herr_t write_bytes(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t offset, std::size_t size, const void* data) {
  bytes_of(file).write(offset, data, size);
  return 0;
}

herr_t get_handle(H5FD_t* file, hid_t, void** handle) {
  *handle = &bytes_of(file);
  return 0;
}

hid_t register_driver() {
  static H5FD_class_t driver = [] {
    H5FD_class_t d{};
#if H5_VERSION_GE(1, 13, 2)
    d.version = H5FD_CLASS_VERSION;
    d.value = static_cast<H5FD_class_value_t>(H5_VFD_RESERVED + 17);
#endif
    d.name = "hooke";
    d.maxaddr = (haddr_t{1} << 62U) - 1;
    d.fc_degree = H5F_CLOSE_STRONG;
    d.fapl_size = sizeof(DriverInfo);
    d.open = open_file;
    d.close = close_file;
    d.query = query;
    d.get_eoa = get_eoa;
    d.set_eoa = set_eoa;
    d.get_eof = get_eof;
    d.get_handle = get_handle;
    d.read = read_bytes;
    d.write = write_bytes;
    const H5FD_mem_t lists[H5FD_MEM_NTYPES] = H5FD_FLMAP_DICHOTOMY;
    for (int i = 0; i < H5FD_MEM_NTYPES; ++i) d.fl_map[i] = lists[i];
    return d;
  }();
  return H5FDregister(&driver);
}

}  // namespace

Handle access_through(JournaledFile& bytes) {
  static const hid_t driver = register_driver();
  Handle access(H5Pcreate(H5P_FILE_ACCESS));
  const DriverInfo info{&bytes};
  // The oldest format that can hold the file: its superblock has no "still being written" mark, which would make other
  // programs refuse the file of a killed run.
  if (driver < 0 || H5Pset_driver(access.get(), driver, &info) < 0 ||
      H5Pset_libver_bounds(access.get(), H5F_LIBVER_EARLIEST, H5F_LIBVER_V18) < 0 ||
      H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG) < 0) {
    throw Failure(Error::Kind::io, bytes.path(), "can't be opened: the HDF5 library refuses Hooke's file driver");
  }
  return access;
}

int read_error_of(hid_t object) {
  const Handle file(H5Iget_file_id(object));
  void* bytes = nullptr;
  if (file.get() < 0 || H5Fget_vfd_handle(file.get(), H5P_DEFAULT, &bytes) < 0) return 0;
  return static_cast<const JournaledFile*>(bytes)->read_error();
}

}  // namespace hooke::io::hdf5
