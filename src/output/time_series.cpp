// SPDX-License-Identifier: MIT
// Time series: columns read from outputs, and files of light curves.
#include "output/time_series.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "output/detail/hdf5_handle.hpp"
#include "output/part_file.hpp"
#include "polhode/error.hpp"
#include "polhode/output/light_curves.hpp"
#include "polhode/tables/light_curve_file.hpp"
#include "tables/number_table.hpp"
#include "tables/table_header.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

namespace {

using detail::attribute_texts;
using detail::Handle;

TimeSeries series_of_table(const std::string& path, std::span<const std::string> columns) {
  NumberTable table = read_number_table(path, columns);
  const detail::TableHeader header = detail::header_of(table);
  TimeSeries series{std::move(table.file), std::move(table.columns), {}};
  for (const std::string& name : columns) {
    const auto unit = header.columns.find(name);
    const bool is_time = name == "t" && header.time.has_value();
    series.units.push_back(unit != header.columns.end() ? unit->second.text
                           : is_time                    ? header.time->text
                                                        : std::string());
  }
  return series;
}

class Hdf5Series {
 public:
  explicit Hdf5Series(const std::string& path)
      : name_(detail::printable(path, path.size())),
        file_(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored))
      throw DomainError(name_ + ": cannot be read: No such file or directory");
    if (file_.id() < 0) throw DomainError(name_ + ": is no HDF5 file that can be read");
  }

  const std::string& name() const { return name_; }

  void append(TimeSeries& series, const std::string& column) const {
    std::vector<std::string> known;
    H5G_info_t info;
    if (H5Gget_info(file_.id(), &info) < 0) info.nlinks = 0;
    for (hsize_t i = 0; i < info.nlinks; ++i) {
      char link[256] = {};
      H5Lget_name_by_idx(file_.id(), ".", H5_INDEX_NAME, H5_ITER_INC, i, link, sizeof link,
                         H5P_DEFAULT);
      const Handle dataset(H5Dopen2(file_.id(), link, H5P_DEFAULT), H5Dclose);
      if (dataset.id() < 0) continue;
      const std::vector<std::string> columns = attribute_texts(dataset.id(), "columns");
      const auto at = std::find(columns.begin(), columns.end(), column);
      if (at != columns.end())
        return read(series, dataset.id(), columns.size(), at - columns.begin());
      known.insert(known.end(), columns.begin(), columns.end());
    }
    const std::vector<std::string_view> words(known.begin(), known.end());
    throw DomainError(name_ + ": has no column " + detail::printable(column, column.size()) +
                      (words.empty() ? "; expected an output of polhode"
                                     : "; expected " + detail::one_of(words)));
  }

 private:
  void read(TimeSeries& series, hid_t dataset, std::size_t width, std::ptrdiff_t at) const {
    const Handle space(H5Dget_space(dataset), H5Sclose);
    hsize_t size[2] = {0, 1};
    const int rank = H5Sget_simple_extent_ndims(space.id());
    std::vector<double> numbers;
    const Handle type(H5Dget_type(dataset), H5Tclose);
    if (H5Tget_class(type.id()) == H5T_STRING)
      throw DomainError(name_ + ": holds dates in this column; expected one of numbers, such as t");
    bool good = (rank == 1 || rank == 2) &&
                H5Sget_simple_extent_dims(space.id(), size, nullptr) >= 0 && size[1] == width;
    if (good) {
      numbers.resize(size[0]);
      const hsize_t start[] = {0, static_cast<hsize_t>(at)}, block[] = {size[0], 1};
      const Handle memory(H5Screate_simple(rank, block, nullptr), H5Sclose);
      good =
          size[0] == 0 ||
          (H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, start, nullptr, block, nullptr) >= 0 &&
           H5Dread(dataset, H5T_NATIVE_DOUBLE, memory.id(), space.id(), H5P_DEFAULT,
                   numbers.data()) >= 0);
    }
    if (!good) throw DomainError(name_ + ": is damaged: its rows cannot be read");
    const std::vector<std::string> units = attribute_texts(dataset, "units");
    series.columns.push_back(std::move(numbers));
    series.units.push_back(units.size() == width ? units[static_cast<std::size_t>(at)] : "");
  }

  std::string name_;
  Handle file_;
};

TimeSeries series_of_hdf5(const std::string& path, std::span<const std::string> columns) {
  const detail::QuietScope quiet;
  const Hdf5Series file(path);
  TimeSeries series{file.name(), {}, {}};
  for (const std::string& column : columns) file.append(series, column);
  for (const std::vector<double>& column : series.columns)
    if (column.size() != series.columns.front().size())
      throw DomainError(file.name() + ": has " + std::to_string(series.columns.front().size()) +
                        " rows of " + columns.front() + " and " + std::to_string(column.size()) +
                        " of another column");
  return series;
}

}  // namespace

TimeSeries read_time_series(const std::string& path, std::span<const std::string> columns) {
  const bool hdf5 = path.ends_with(".h5") || path.ends_with(".hdf5");
  return hdf5 ? series_of_hdf5(path, columns) : series_of_table(path, columns);
}

namespace {

void write_whole(const std::string& path, std::string_view text) {
  detail::PartFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace

void write_lc(const std::string& path, std::span<const light::LightCurve> curves,
              const ephemeris::Date& epoch) {
  write_whole(path, lc_text(curves, epoch));
}

void write_light_csv(const std::string& path, std::span<const light::LightCurve> curves,
                     std::span<const std::string> notes) {
  write_whole(path, light_csv(curves, notes));
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
