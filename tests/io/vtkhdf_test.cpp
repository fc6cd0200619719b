// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Reads particles.vtkhdf with plain HDF5, step by step as the VTKHDF specification prescribes for temporal PolyData and
// as VTK's reader does.
#include <gtest/gtest.h>
#include <hdf5.h>

#include <cstring>
#include <numeric>

#include "hooke/io/run_folder.h"
#include "samples.h"

namespace hooke {
namespace {

class Vtkhdf : public testing::Test {
 protected:
  void SetUp() override {
    auto writer = io::RunWriter::create(folder / "run", samples::run_info(), "{}", {});
    for (std::size_t k = 0; k < counts.size(); ++k) {
      ASSERT_TRUE(writer->write_snapshot(samples::snapshot(static_cast<std::int64_t>(8 * k), counts[k])));
    }
    // Not finished: plain HDF5 reads a run that goes on.
    ASSERT_TRUE(writer->flush());
    writer_ = std::make_unique<io::RunWriter>(std::move(*writer));
    file = H5Fopen((folder / "run/particles.vtkhdf").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    ASSERT_GE(file, 0);
  }
  void TearDown() override { H5Fclose(file); }

  /// Numbers `start` to `start + count` of a table of any stored type.
  template <class T>
  std::vector<T> read(const std::string& name, hid_t type, hsize_t start, hsize_t count, hsize_t width = 1) {
    const hid_t dataset = H5Dopen2(file, ("VTKHDF/" + name).c_str(), H5P_DEFAULT);
    EXPECT_GE(dataset, 0) << name;
    const hid_t space = H5Dget_space(dataset);
    EXPECT_EQ(H5Sget_simple_extent_ndims(space), width == 1 ? 1 : 2) << name;
    const hsize_t from[2] = {start, 0};
    const hsize_t size[2] = {count, width};
    H5Sselect_hyperslab(space, H5S_SELECT_SET, from, nullptr, size, nullptr);
    EXPECT_GT(H5Sselect_valid(space), 0) << name << ' ' << start << ' ' << count;
    const hid_t memory = H5Screate_simple(width == 1 ? 1 : 2, size, nullptr);
    std::vector<T> values(count * width);
    EXPECT_GE(H5Dread(dataset, type, memory, space, H5P_DEFAULT, values.data()), 0) << name;
    H5Sclose(memory);
    H5Sclose(space);
    H5Dclose(dataset);
    return values;
  }
  std::vector<std::int64_t> whole(const std::string& name, hsize_t start, hsize_t count, hsize_t width = 1) {
    return read<std::int64_t>(name, H5T_NATIVE_INT64, start, count, width);
  }
  std::string stored_type(const std::string& name) {
    const hid_t dataset = H5Dopen2(file, ("VTKHDF/" + name).c_str(), H5P_DEFAULT);
    const hid_t type = H5Dget_type(dataset);
    const std::string text =
        std::string(H5Tget_class(type) == H5T_FLOAT ? "float" : "int") + std::to_string(8 * H5Tget_size(type));
    H5Tclose(type);
    H5Dclose(dataset);
    return text;
  }

  const std::vector<std::size_t> counts{3000, 3000, 2000, 2000, 3500, 1};
  samples::TemporaryFolder folder;
  std::unique_ptr<io::RunWriter> writer_;
  hid_t file = -1;
};

TEST_F(Vtkhdf, SaysWhatItIs) {
  const hid_t group = H5Gopen2(file, "VTKHDF", H5P_DEFAULT);
  std::int64_t version[2] = {};
  const hid_t version_attribute = H5Aopen(group, "Version", H5P_DEFAULT);
  H5Aread(version_attribute, H5T_NATIVE_INT64, version);
  EXPECT_EQ(version[0], 2);
  EXPECT_EQ(version[1], 0);
  // VTK requires an ASCII text of fixed length.
  const hid_t type_attribute = H5Aopen(group, "Type", H5P_DEFAULT);
  const hid_t type = H5Aget_type(type_attribute);
  EXPECT_EQ(H5Tget_class(type), H5T_STRING);
  EXPECT_EQ(H5Tis_variable_str(type), 0);
  EXPECT_EQ(H5Tget_cset(type), H5T_CSET_ASCII);
  ASSERT_EQ(H5Tget_size(type), 8U);
  char text[8];
  H5Aread(type_attribute, type, text);
  EXPECT_EQ(std::string(text, 8), "PolyData");
  const hid_t steps = H5Gopen2(file, "VTKHDF/Steps", H5P_DEFAULT);
  const hid_t steps_attribute = H5Aopen(steps, "NSteps", H5P_DEFAULT);
  int n = 0;
  H5Aread(steps_attribute, H5T_NATIVE_INT, &n);
  EXPECT_EQ(n, static_cast<int>(counts.size()));
  for (const hid_t each : {version_attribute, type_attribute, steps_attribute}) H5Aclose(each);
  H5Tclose(type);
  H5Gclose(steps);
  H5Gclose(group);
}

TEST_F(Vtkhdf, StoresNumbersInThePrecisionOfTheRun) {
  EXPECT_EQ(stored_type("Points"), "float32");
  EXPECT_EQ(stored_type("PointData/velocity"), "float32");
  EXPECT_EQ(stored_type("PointData/radius"), "float32");
  EXPECT_EQ(stored_type("PointData/id"), "int64");
  EXPECT_EQ(stored_type("PointData/material"), "int16");
  EXPECT_EQ(stored_type("Steps/Values"), "float64");
}

TEST_F(Vtkhdf, EveryStepIsWhereTheSpecificationLooksForIt) {
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const Snapshot expected = samples::snapshot(static_cast<std::int64_t>(8 * k), counts[k]);
    const std::size_t n = counts[k];
    EXPECT_EQ(read<double>("Steps/Values", H5T_NATIVE_DOUBLE, k, 1)[0], expected.time);
    EXPECT_EQ(whole("Steps/NumberOfParts", k, 1)[0], 1);
    const auto part = static_cast<hsize_t>(whole("Steps/PartOffsets", k, 1)[0]);
    ASSERT_EQ(whole("NumberOfPoints", part, 1)[0], static_cast<std::int64_t>(n));
    const auto cell_offsets = whole("Steps/CellOffsets", k, 1, 4);
    const auto connectivity_offsets = whole("Steps/ConnectivityIdOffsets", k, 1, 4);
    const char* topologies[] = {"Vertices", "Lines", "Polygons", "Strips"};
    for (std::size_t t = 0; t < 4; ++t) {
      const std::string name = topologies[t];
      const std::size_t cells = t == 0 ? n : 0;
      ASSERT_EQ(whole(name + "/NumberOfCells", part, 1)[0], static_cast<std::int64_t>(cells));
      ASSERT_EQ(whole(name + "/NumberOfConnectivityIds", part, 1)[0], static_cast<std::int64_t>(cells));
      // Every part has one offset more than cells, so VTK 9.3 adds the number of parts before. Later versions count
      // the parts up to this cell offset, which gives the same where there are cells.
      std::vector<std::int64_t> ascending(cells + 1);
      std::iota(ascending.begin(), ascending.end(), 0);
      const auto cell_offset = static_cast<hsize_t>(cell_offsets[t]);
      EXPECT_EQ(whole(name + "/Offsets", cell_offset + part, cells + 1), ascending);
      const auto before = whole(name + "/NumberOfCells", 0, part);
      hsize_t parts_before = 0;
      std::int64_t sum = 0;
      while (parts_before < part && sum < cell_offsets[t]) sum += before[parts_before++];
      EXPECT_EQ(whole(name + "/Offsets", cell_offset + parts_before, cells + 1), ascending);
      ascending.pop_back();
      EXPECT_EQ(whole(name + "/Connectivity", static_cast<hsize_t>(connectivity_offsets[t]), cells), ascending);
    }
    const auto offset_of = [&](const char* array) {
      return static_cast<hsize_t>(whole(std::string("Steps/PointDataOffsets/") + array, k, 1)[0]);
    };
    const auto points =
        read<float>("Points", H5T_NATIVE_FLOAT, static_cast<hsize_t>(whole("Steps/PointOffsets", k, 1)[0]), n, 3);
    const auto velocity = read<float>("PointData/velocity", H5T_NATIVE_FLOAT, offset_of("velocity"), n, 3);
    const auto id = whole("PointData/id", offset_of("id"), n);
    const auto material = whole("PointData/material", offset_of("material"), n);
    const auto radius = read<float>("PointData/radius", H5T_NATIVE_FLOAT, offset_of("radius"), n);
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3d& x = expected.particles.position[i];
      const Vec3d& v = expected.particles.velocity[i];
      ASSERT_EQ(Vec3d(points[3 * i], points[3 * i + 1], points[3 * i + 2]), x);
      ASSERT_EQ(Vec3d(velocity[3 * i], velocity[3 * i + 1], velocity[3 * i + 2]), v);
      ASSERT_EQ(id[i], static_cast<std::int64_t>(expected.particles.id[i]));
      ASSERT_EQ(material[i], expected.particles.material[i]);
      ASSERT_EQ(radius[i], material[i] == 0 ? 0.2F : 0.35F);
    }
  }
}

TEST_F(Vtkhdf, DoesNotRepeatWhatStaysTheSame) {
  EXPECT_EQ(whole("Steps/PartOffsets", 0, 6), (std::vector<std::int64_t>{0, 0, 1, 1, 2, 3}));
  const auto ids = whole("Steps/PointDataOffsets/id", 0, 6);
  EXPECT_EQ(ids[0], ids[1]);
  EXPECT_EQ(ids[2], ids[3]);
  EXPECT_LT(ids[1], ids[2]);
}

}  // namespace
}  // namespace hooke
