// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Files that are sound for HDF5, but whose tables are of another type, rank or length than Hooke's, or point beyond
// each other: they are refused, and nothing is read or written out of bounds.
#include <gtest/gtest.h>
#include <hdf5.h>

#include <cstring>
#include <functional>

#include "hooke/base/process_usage.h"
#include "hooke/io/checkpoint.h"
#include "hooke/io/describe_file.h"
#include "hooke/io/run_folder.h"
#include "hooke/io/seal.h"
#include "samples.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;

/// Changes a file by plain HDF5.
void edit(const fs::path& file, const std::function<void(hid_t)>& change) {
  const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  ASSERT_GE(id, 0);
  change(id);
  ASSERT_GE(H5Fclose(id), 0);
}

/// Puts another dataset, of zeros, in place of one. `chunk`: rows of a chunk, 0 for a contiguous dataset.
void replace(hid_t file, const char* name, hid_t type, const std::vector<hsize_t>& size, hsize_t chunk = 0) {
  H5Ldelete(file, name, H5P_DEFAULT);
  const hid_t space =
      size.empty() ? H5Screate(H5S_SCALAR) : H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr);
  const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
  std::vector<hsize_t> chunks = size;
  if (chunk > 0) {
    chunks[0] = chunk;
    H5Pset_chunk(properties, static_cast<int>(size.size()), chunks.data());
  }
  const hid_t dataset = H5Dcreate2(file, name, type, space, H5P_DEFAULT, properties, H5P_DEFAULT);
  EXPECT_GE(dataset, 0) << name;
  H5Dclose(dataset);
  H5Pclose(properties);
  H5Sclose(space);
}

hid_t text_type(std::size_t size) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, size);
  return type;
}

template <class T>
void set_entry(hid_t file, const char* name, std::size_t entry, T value, hid_t type) {
  const hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT);
  const hid_t space = H5Dget_space(dataset);
  std::vector<T> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  ASSERT_GE(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0) << name;
  ASSERT_LT(entry, values.size()) << name;
  values[entry] = value;
  ASSERT_GE(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0) << name;
  H5Sclose(space);
  H5Dclose(dataset);
}

/// The one error of reading a file.
template <class T>
void expect_refused(const Expected<T>& read) {
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().kind, Error::Kind::bad_input);
  EXPECT_EQ(read.error().findings.size(), 1U);
  EXPECT_NE(read.error().text().find("damaged"), std::string::npos) << read.error().text();
}

class DamagedSnapshots : public testing::Test {
 protected:
  DamagedSnapshots() {
    samples::write_run(folder / "run", samples::run_info(), {samples::snapshot(0, 3000), samples::snapshot(8, 2000)});
    whole = samples::read_file(file);
  }
  /// Expects that a snapshot, or the file as a whole, is refused after a change.
  void expect_refused_after(const std::function<void(hid_t)>& change) {
    samples::write_file(file, whole);
    edit(file, change);
    const auto run = io::RunReader::open(file);
    if (!run) {
      expect_refused(run);
      return;
    }
    ASSERT_GT(run->size(), 0U);
    expect_refused(run->read(run->size() - 1));
  }

  samples::TemporaryFolder folder;
  fs::path file = folder / "run/particles.vtkhdf";
  std::string whole;
};

TEST_F(DamagedSnapshots, TextsAreOneOfALengthThatTheFileHolds) {
  expect_refused_after([](hid_t f) { replace(f, "Hooke/run", text_type(300), {1000}); });
  expect_refused_after([](hid_t f) { replace(f, "Hooke/run", text_type(300), {10, 10}); });
  expect_refused_after([](hid_t f) { replace(f, "Hooke/run", text_type(0x40000000), {}); });
  expect_refused_after([](hid_t f) { replace(f, "Hooke/run", text_type(H5T_VARIABLE), {}); });
  expect_refused_after([](hid_t f) { replace(f, "Hooke/run", H5T_STD_I64LE, {}); });
  expect_refused_after([](hid_t f) { replace(f, "Hooke/run", text_type(300), {0}); });
}

TEST_F(DamagedSnapshots, AttributesAreSingleNumbers) {
  const auto set_attribute = [](hid_t f, hid_t type, hsize_t count) {
    const hid_t steps = H5Gopen2(f, "VTKHDF/Steps", H5P_DEFAULT);
    H5Adelete(steps, "NSteps");
    const hid_t space = H5Screate_simple(1, &count, nullptr);
    H5Aclose(H5Acreate2(steps, "NSteps", type, space, H5P_DEFAULT, H5P_DEFAULT));
    H5Sclose(space);
    H5Gclose(steps);
  };
  expect_refused_after([&](hid_t f) { set_attribute(f, H5T_STD_I64LE, 500); });
  expect_refused_after([&](hid_t f) { set_attribute(f, text_type(400), 1); });
  expect_refused_after([&](hid_t f) { set_attribute(f, H5T_IEEE_F64LE, 1); });
}

TEST_F(DamagedSnapshots, TablesAreOfTheirTypeRankAndWidth) {
  for (const char* name : {"VTKHDF/Points", "VTKHDF/PointData/velocity"}) {
    expect_refused_after([&](hid_t f) { replace(f, name, H5T_IEEE_F32LE, {4096, 8}, 1024); });
    expect_refused_after([&](hid_t f) { replace(f, name, H5T_IEEE_F32LE, {4096}, 1024); });
    expect_refused_after([&](hid_t f) { replace(f, name, H5T_STD_I64LE, {4096, 3}, 1024); });
    expect_refused_after([&](hid_t f) { replace(f, name, H5T_IEEE_F32LE, {4096, 3}); });
  }
  for (const char* name : {"Hooke/step", "VTKHDF/Steps/PartOffsets", "VTKHDF/NumberOfPoints", "VTKHDF/PointData/id"}) {
    expect_refused_after([&](hid_t f) { replace(f, name, H5T_STD_I64LE, {2, 100}, 2); });
    expect_refused_after([&](hid_t f) { replace(f, name, text_type(64), {2}, 2); });
    expect_refused_after([&](hid_t f) { replace(f, name, H5T_IEEE_F64LE, {2}, 2); });
  }
}

// A table may claim rows that it does not store: HDF5 reads them as zeros.
TEST_F(DamagedSnapshots, TablesAreNoLongerThanTheirFile) {
  constexpr hsize_t kHuge = hsize_t{1} << 40U;
  for (const char* name : {"Hooke/step", "VTKHDF/Steps/PartOffsets", "VTKHDF/NumberOfPoints", "VTKHDF/PointData/id"}) {
    expect_refused_after([&](hid_t f) { replace(f, name, H5T_STD_I64LE, {kHuge}, 1024); });
  }
  expect_refused_after([&](hid_t f) { replace(f, "VTKHDF/Points", H5T_IEEE_F32LE, {kHuge, 3}, 1024); });
}

TEST_F(DamagedSnapshots, OffsetsStayWithinTheirTables) {
  for (const char* name :
       {"VTKHDF/Steps/PartOffsets", "VTKHDF/Steps/PointOffsets", "VTKHDF/Steps/PointDataOffsets/id",
        "VTKHDF/Steps/PointDataOffsets/velocity", "VTKHDF/Steps/PointDataOffsets/material", "VTKHDF/NumberOfPoints"}) {
    for (const std::int64_t value : {std::int64_t{-1}, std::int64_t{1} << 40U, INT64_MAX, INT64_MIN}) {
      SCOPED_TRACE(std::string(name) + ' ' + std::to_string(value));
      expect_refused_after([&](hid_t f) { set_entry(f, name, 1, value, H5T_NATIVE_INT64); });
    }
  }
}

// Tables that are sound by themselves, but not what was written: HDF5's own tables of chunks, which bear no checksums,
// may lead elsewhere after one changed bit.
TEST_F(DamagedSnapshots, ASnapshotIsWhatWasWritten) {
  for (const char* name : {"VTKHDF/Steps/PointOffsets", "VTKHDF/Steps/PointDataOffsets/velocity"}) {
    SCOPED_TRACE(name);
    expect_refused_after([&](hid_t f) { set_entry(f, name, 1, std::int64_t{0}, H5T_NATIVE_INT64); });
  }
  expect_refused_after([&](hid_t f) { set_entry(f, "Hooke/step", 1, std::int64_t{1} << 20U, H5T_NATIVE_INT64); });
}

TEST_F(DamagedSnapshots, TheDescriptionOfTheRunIsWhatWasWritten) {
  const std::size_t at = whole.find("\"materials\"");
  ASSERT_NE(at, std::string::npos);
  const std::size_t digit = whole.find_first_of("123456789", at);
  std::string damaged = whole;
  damaged[digit] = static_cast<char>(damaged[digit] ^ 1);
  samples::write_file(file, damaged);
  expect_refused(io::RunReader::open(file));
}

// Every chunk that is read bears a checksum.
TEST_F(DamagedSnapshots, AChangedBitIsRefused) {
  for (const char* name :
       {"VTKHDF/Points", "VTKHDF/PointData/velocity", "VTKHDF/PointData/id", "VTKHDF/PointData/material", "Hooke/step",
        "VTKHDF/NumberOfPoints", "VTKHDF/Steps/Values", "VTKHDF/Steps/PartOffsets", "VTKHDF/Steps/PointOffsets"}) {
    samples::write_file(file, whole);
    hsize_t chunks = 0;
    std::vector<haddr_t> address;
    std::vector<hsize_t> size;
    edit(file, [&](hid_t f) {
      const hid_t dataset = H5Dopen2(f, name, H5P_DEFAULT);
      const hid_t space = H5Dget_space(dataset);
      H5Dget_num_chunks(dataset, space, &chunks);
      address.resize(chunks);
      size.resize(chunks);
      for (hsize_t k = 0; k < chunks; ++k) {
        H5Dget_chunk_info(dataset, space, k, nullptr, nullptr, &address[k], &size[k]);
      }
      H5Sclose(space);
      H5Dclose(dataset);
    });
    ASSERT_GT(chunks, 0U) << name;
    for (const hsize_t at : {hsize_t{0}, size.back() / 2, size.back() - 1}) {
      SCOPED_TRACE(std::string(name) + " byte " + std::to_string(at));
      std::string damaged = whole;
      damaged[address.back() + at] = static_cast<char>(damaged[address.back() + at] ^ 16);
      samples::write_file(file, damaged);
      const auto run = io::RunReader::open(file);
      if (run) {
        expect_refused(run->read(1));
      } else {
        expect_refused(run);
      }
    }
  }
}

class DamagedCheckpoints : public testing::Test {
 protected:
  DamagedCheckpoints() {
    EXPECT_TRUE(io::write_checkpoint(file, samples::state(3, 100), samples::run_info()));
    const std::string sealed = samples::read_file(file);
    whole = sealed.substr(0, sealed.size() - 2 * sizeof(std::uint64_t));
  }
  /// Makes the seal anew: it guards against accidents, not against somebody.
  void seal() { io::append_seal(file); }
  void expect_refused_after(const std::function<void(hid_t)>& change, bool of_structure = true) {
    samples::write_file(file, whole);
    edit(file, change);
    seal();
    expect_refused(io::read_checkpoint(file));
    expect_refused(io::describe_file(file));
    if (of_structure) expect_refused(io::read_structure_of_run(folder.path()));
  }

  samples::TemporaryFolder folder;
  fs::path file = folder / "checkpoint.h5";
  std::string whole;
};

TEST_F(DamagedCheckpoints, AreSoundWithANewSeal) {
  samples::write_file(file, whole);
  seal();
  EXPECT_TRUE(io::read_checkpoint(file));
  EXPECT_TRUE(io::read_structure_of_run(folder.path()));
}

// A file that claims to have a driver's block behind its end: what follows there, which is its seal, is read as a size,
// and HDF5 takes the memory before it looks further.
TEST_F(DamagedCheckpoints, WhatIsBehindTheEndTakesNoMemory) {
  std::string bytes(257, '\0');
  bytes.replace(0, 8, "\x89HDF\r\n\x1a\n");
  bytes[13] = bytes[14] = 8;  // bytes of an offset, of a length
  bytes[16] = 4, bytes[18] = 16;  // entries of nodes
  std::fill(bytes.begin() + 23, bytes.begin() + 127, '\xff');
  std::fill(bytes.begin() + 49, bytes.begin() + 82, '\0');
  samples::write_file(file, bytes);
  seal();
  const std::uint64_t before = peak_resident_bytes();
  expect_refused(io::read_checkpoint(file));
  EXPECT_LT(peak_resident_bytes() - before, std::uint64_t{256} << 20U);
}

TEST_F(DamagedCheckpoints, TablesAreOfTheirTypeRankAndLength) {
  for (const char* name : {"position", "velocity", "acceleration"}) {
    expect_refused_after([&](hid_t f) { replace(f, name, H5T_IEEE_F64LE, {100}); }, false);
    expect_refused_after([&](hid_t f) { replace(f, name, H5T_IEEE_F32LE, {100, 3}); }, false);
    expect_refused_after([&](hid_t f) { replace(f, name, H5T_IEEE_F64LE, {99, 3}); }, false);
    expect_refused_after([&](hid_t f) { replace(f, name, H5T_IEEE_F64LE, {hsize_t{1} << 40U, 3}); }, false);
  }
  expect_refused_after([](hid_t f) { replace(f, "run", text_type(400), {1000}); }, false);
  expect_refused_after([](hid_t f) { replace(f, "id", H5T_STD_I64LE, {100}); }, false);
  expect_refused_after([](hid_t f) { replace(f, "material", text_type(2), {100}); }, false);
  expect_refused_after([](hid_t f) { replace(f, "surfaces", text_type(400), {1000}); });
}

TEST_F(DamagedCheckpoints, CornersOfTrianglesAreParticlesOfTheirSurface) {
  for (const std::uint32_t corner : {3U, 4U, 0x80000000U}) {
    expect_refused_after([&](hid_t f) { set_entry(f, "surface_triangles", 2, corner, H5T_NATIVE_UINT32); });
  }
  expect_refused_after([](hid_t f) { replace(f, "surface_triangles", H5T_STD_U32LE, {8}); });
  expect_refused_after([](hid_t f) { replace(f, "surface_triangles", H5T_STD_U32LE, {12}); });
}

TEST_F(DamagedCheckpoints, ColumnsOfSpringsAreOfOneLength) {
  for (const char* name : {"spring_rest_length", "spring_stiffness", "spring_damping", "spring_break_strain"}) {
    expect_refused_after([&](hid_t f) { replace(f, name, H5T_IEEE_F64LE, {3}); });
  }
  for (const char* name : {"spring_a", "spring_b"}) {
    expect_refused_after([&](hid_t f) { replace(f, name, H5T_STD_U64LE, {3}); });
  }
  for (const char* name : {"spring_mode", "spring_contact"}) {
    expect_refused_after([&](hid_t f) { replace(f, name, H5T_STD_U8LE, {3}); });
  }
}

TEST_F(DamagedCheckpoints, IdsAndIndicesAreInRangeAndAscend) {
  const auto next_id = samples::state(3, 100).next_id;
  for (const char* name : {"spring_a", "spring_b", "surface_particles"}) {
    expect_refused_after([&](hid_t f) { set_entry(f, name, 1, next_id, H5T_NATIVE_UINT64); });
  }
  expect_refused_after([&](hid_t f) { set_entry(f, "held", 19, next_id, H5T_NATIVE_UINT64); });
  expect_refused_after([](hid_t f) { set_entry(f, "held", 1, std::uint64_t{1}, H5T_NATIVE_UINT64); });
  expect_refused_after([](hid_t f) { set_entry(f, "broken_springs", 1, std::uint64_t{0}, H5T_NATIVE_UINT64); });
  expect_refused_after([](hid_t f) { set_entry(f, "broken_springs", 14, std::uint64_t{100}, H5T_NATIVE_UINT64); });
}

}  // namespace
}  // namespace hooke
