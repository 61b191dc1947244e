// SPDX-License-Identifier: MIT
// HDF5: one dataset per column group, units and provenance as attributes, flushed block by block.
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "output/detail/hdf5_handle.hpp"
#include "output/formats/formats.hpp"
#include "output/output_notes.hpp"
#include "output/part_file.hpp"
#include "polhode/error.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

constexpr hsize_t rows_per_chunk = 1024;
constexpr std::size_t date_length = 26;  // 2029-04-13T21:46:00.500000
// By this name the NetCDF-4 library knows a dimension without values.
constexpr const char* no_variable = "This is a netCDF dimension but not a netCDF variable.";

bool has_coordinate(const std::vector<ColumnGroup>& groups, const std::string& dimension) {
  return !groups.empty() && groups.front().name == dimension && groups.front().columns.size() == 1;
}

std::string row_dimension_of(const std::vector<ColumnGroup>& groups, const Provenance& provenance) {
  std::string name = !provenance.row_dimension.empty() ? provenance.row_dimension
                     : has_coordinate(groups, "t")     ? "t"
                                                       : "row";
  if (has_coordinate(groups, name)) return name;
  while (std::ranges::find(groups, name, &ColumnGroup::name) != groups.end()) name += "_";
  return name;
}

// Dates are texts of one length, filled up with zeros.
Handle date_type() {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), date_length);
  H5Tset_strpad(type.id(), H5T_STR_NULLPAD);
  return type;
}

// Texts of any length: variable-length UTF-8, which h5py reads as str.
Handle text_type() {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), H5T_VARIABLE);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  return type;
}

class Hdf5Sink : public Sink, public ClosingNotes {
 public:
  Hdf5Sink(const std::string& path, const std::vector<ColumnGroup>& groups,
           const Provenance& provenance, const std::optional<SinkPosition>& from,
           const RowDates& dates);
  ~Hdf5Sink() override;
  void push(std::span<const double> rows) override;
  std::optional<SinkPosition> position() override;
  void kept() override;
  void close_with(const std::string& name, const std::vector<std::string>& notes) override;
  void finish() override;

 private:
  struct Group {
    Handle dataset;
    std::size_t first;  // column in a row
    std::size_t columns;
  };
  void require(bool good) const;
  Handle checked(hid_t id, herr_t (*close)(hid_t)) const;
  Handle opened_file(bool exists);
  Handle opened_dataset(const std::string& name) const;
  // Datasets of one number or date per row.
  bool is_flat(const ColumnGroup& group) const;
  Handle created_dataset(const ColumnGroup& group) const;
  Handle created_dimension() const;
  void attach(hid_t object, const char* name, const std::vector<std::string>& texts, bool scalar);
  void append(const Group& group, std::span<const double> rows, std::size_t count);
  std::string date_texts() const;
  void describe(const std::vector<ColumnGroup>& groups, const Provenance& provenance);
  void name_dimensions(const std::vector<ColumnGroup>& groups);
  void name_scale(hid_t dataset, const std::string& name) const;
  void list_scales(hid_t dataset, const std::vector<std::string>& scales) const;
  void require_same_scenario(const Provenance& provenance) const;
  // The state that HDF5 has flushed becomes the file.
  void commit();

  std::string path_;
  std::string part_;
  JournaledFile bytes_;
  Handle file_;
  std::vector<Group> groups_;  // a dimension without coordinate is the last one, of no columns
  std::string row_dimension_;
  std::size_t width_ = 0;
  hsize_t written_ = 0;
  std::vector<double> columns_;
  RowDates dates_;
};

void Hdf5Sink::require(bool good) const {
  if (!good) fail_to_write(part_, errno == 0 ? EIO : errno);
}

Handle Hdf5Sink::checked(hid_t id, herr_t (*close)(hid_t)) const {
  require(id >= 0);
  return {id, close};
}

Handle Hdf5Sink::opened_file(bool exists) {
  const QuietScope quiet;
  errno = 0;
  const Handle access = checked(access_to(bytes_), H5Pclose);
  if (exists) {
    const hid_t id = H5Fopen(part_.c_str(), H5F_ACC_RDWR, access.id());
    if (id < 0) throw DomainError(printable(part_, part_.size()) + ": HDF5 cannot read it");
    return {id, H5Fclose};
  }
  const Handle creation = checked(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  require(H5Pset_obj_track_times(creation.id(), false) >= 0);
  return checked(H5Fcreate(part_.c_str(), H5F_ACC_TRUNC, creation.id(), access.id()), H5Fclose);
}

// With as many rows as have been written.
Handle Hdf5Sink::opened_dataset(const std::string& name) const {
  Handle dataset = checked(H5Dopen2(file_.id(), name.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle space = checked(H5Dget_space(dataset.id()), H5Sclose);
  hsize_t size[2] = {0, 1};
  require(H5Sget_simple_extent_ndims(space.id()) <= 2 &&
          H5Sget_simple_extent_dims(space.id(), size, nullptr) >= 0);
  if (size[0] != written_)
    throw DomainError(printable(part_, part_.size()) + ": has " + std::to_string(size[0]) +
                      " rows; expected " + std::to_string(written_));
  return dataset;
}

bool Hdf5Sink::is_flat(const ColumnGroup& group) const {
  return group.columns.size() == 1 &&
         (group.columns.front().is_date || group.name == "t" || group.name == row_dimension_);
}

Handle Hdf5Sink::created_dataset(const ColumnGroup& group) const {
  const bool is_date = group.columns.front().is_date;
  const int rank = is_flat(group) ? 1 : 2;
  const hsize_t columns = group.columns.size();
  const hsize_t now[] = {0, columns}, most[] = {H5S_UNLIMITED, columns};
  const hsize_t chunk[] = {rows_per_chunk, columns};
  const Handle space = checked(H5Screate_simple(rank, now, most), H5Sclose);
  const Handle creation = checked(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  require(H5Pset_chunk(creation.id(), rank, chunk) >= 0 &&
          H5Pset_obj_track_times(creation.id(), false) >= 0);
  const Handle text = date_type();
  return checked(H5Dcreate2(file_.id(), group.name.c_str(), is_date ? text.id() : H5T_IEEE_F64LE,
                            space.id(), H5P_DEFAULT, creation.id(), H5P_DEFAULT),
                 H5Dclose);
}

// A chunked dataset takes no room before it is written.
Handle Hdf5Sink::created_dimension() const {
  const hsize_t now = 0, most = H5S_UNLIMITED, chunk = rows_per_chunk;
  const Handle space = checked(H5Screate_simple(1, &now, &most), H5Sclose);
  const Handle creation = checked(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  require(H5Pset_chunk(creation.id(), 1, &chunk) >= 0 &&
          H5Pset_obj_track_times(creation.id(), false) >= 0);
  return checked(H5Dcreate2(file_.id(), row_dimension_.c_str(), H5T_STD_U8LE, space.id(),
                            H5P_DEFAULT, creation.id(), H5P_DEFAULT),
                 H5Dclose);
}

void Hdf5Sink::attach(hid_t object, const char* name, const std::vector<std::string>& texts,
                      bool scalar) {
  std::vector<const char*> pointers;
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  const hsize_t count = pointers.size();
  const Handle type = text_type();
  const Handle space =
      checked(scalar ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr), H5Sclose);
  const Handle attribute =
      checked(H5Acreate2(object, name, type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  require(pointers.empty() || H5Awrite(attribute.id(), type.id(), pointers.data()) >= 0);
}

Hdf5Sink::Hdf5Sink(const std::string& path, const std::vector<ColumnGroup>& groups,
                   const Provenance& provenance, const std::optional<SinkPosition>& from,
                   const RowDates& dates)
    : path_(path),
      part_(part_path(path)),
      bytes_(from ? JournaledFile(part_, {from->bytes, from->rows}) : JournaledFile(part_)),
      file_(opened_file(from.has_value())),
      row_dimension_(row_dimension_of(groups, provenance)),
      written_(from ? static_cast<hsize_t>(from->rows) : 0),
      dates_(dates) {
  const QuietScope quiet;
  if (from) require_same_scenario(provenance);
  for (const ColumnGroup& group : groups) {
    if (group.columns.empty()) continue;
    groups_.push_back(
        {from ? opened_dataset(group.name) : created_dataset(group), width_, group.columns.size()});
    width_ += group.columns.size();
  }
  if (!has_coordinate(groups, row_dimension_))
    groups_.push_back({from ? opened_dataset(row_dimension_) : created_dimension(), width_, 0});
  if (from) return;
  describe(groups, provenance);
  commit();
}

void Hdf5Sink::describe(const std::vector<ColumnGroup>& groups, const Provenance& provenance) {
  auto dataset = groups_.begin();
  for (const ColumnGroup& group : groups) {
    if (group.columns.empty()) continue;
    std::vector<std::string> names, units;
    for (const Column& column : group.columns) {
      names.push_back(column.name);
      units.push_back(column.unit);
    }
    attach(dataset->dataset.id(), "columns", names, false);
    attach(dataset->dataset.id(), "units", units, false);
    ++dataset;
  }
  name_dimensions(groups);
  std::vector<std::string> order;  // of the datasets, which HDF5 has by name
  for (const ColumnGroup& group : groups)
    if (!group.columns.empty()) order.push_back(group.name);
  attach(file_.id(), "groups", order, false);
  attach(file_.id(), "polhode", {provenance.version}, true);
  attach(file_.id(), "title", {provenance.title}, true);
  attach(file_.id(), "scenario_name", {provenance.scenario_name}, true);
  attach(file_.id(), "scenario", {provenance.scenario_text}, true);
  attach(file_.id(), "notes", provenance.notes, false);
  attach(file_.id(), "citations", provenance.citations, false);
}

// Dimension scales, as NetCDF-4 and xarray read them: rows by t, another coordinate or a length
// only; columns by their names in a dataset GROUP_column.
void Hdf5Sink::name_dimensions(const std::vector<ColumnGroup>& groups) {
  if (has_coordinate(groups, row_dimension_))
    name_scale(groups_.front().dataset.id(), row_dimension_);
  else
    name_scale(groups_.back().dataset.id(), no_variable);
  auto dataset = groups_.begin();
  for (const ColumnGroup& group : groups) {
    if (group.columns.empty()) continue;
    const hid_t id = (dataset++)->dataset.id();
    if (group.name == row_dimension_) continue;
    if (is_flat(group)) {
      list_scales(id, {row_dimension_});
      continue;
    }
    const std::string name = group.name + "_column";
    const hsize_t count = group.columns.size();
    std::vector<const char*> texts;
    for (const Column& column : group.columns) texts.push_back(column.name.c_str());
    const Handle type = text_type(),
                 space = checked(H5Screate_simple(1, &count, nullptr), H5Sclose);
    const Handle creation = checked(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    require(H5Pset_obj_track_times(creation.id(), false) >= 0);
    const Handle names = checked(H5Dcreate2(file_.id(), name.c_str(), type.id(), space.id(),
                                            H5P_DEFAULT, creation.id(), H5P_DEFAULT),
                                 H5Dclose);
    require(H5Dwrite(names.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, texts.data()) >= 0);
    name_scale(names.id(), name);
    list_scales(id, {row_dimension_, name});
  }
}

void Hdf5Sink::name_scale(hid_t dataset, const std::string& name) const {
  const std::pair<const char*, std::string> texts[] = {{"CLASS", "DIMENSION_SCALE"},
                                                       {"NAME", name}};
  for (const auto& [key, text] : texts) {
    const Handle type = checked(H5Tcopy(H5T_C_S1), H5Tclose);
    require(H5Tset_size(type.id(), text.size() + 1) >= 0);
    const Handle space = checked(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle attribute = checked(
        H5Acreate2(dataset, key, type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    require(H5Awrite(attribute.id(), type.id(), text.c_str()) >= 0);
  }
}

void Hdf5Sink::list_scales(hid_t dataset, const std::vector<std::string>& scales) const {
  std::vector<hobj_ref_t> references(scales.size());
  std::vector<hvl_t> lists(scales.size());
  for (std::size_t i = 0; i < scales.size(); ++i) {
    require(H5Rcreate(&references[i], file_.id(), scales[i].c_str(), H5R_OBJECT, -1) >= 0);
    lists[i] = {1, &references[i]};
  }
  const hsize_t rank = scales.size();
  const Handle type = checked(H5Tvlen_create(H5T_STD_REF_OBJ), H5Tclose);
  const Handle space = checked(H5Screate_simple(1, &rank, nullptr), H5Sclose);
  const Handle attribute = checked(
      H5Acreate2(dataset, "DIMENSION_LIST", type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  require(H5Awrite(attribute.id(), type.id(), lists.data()) >= 0);
}

void Hdf5Sink::require_same_scenario(const Provenance& provenance) const {
  const bool same =
      attribute_texts(file_.id(), "scenario") == std::vector{provenance.scenario_text};
  if (!same)
    throw DomainError(printable(part_, part_.size()) +
                      ": cannot be continued: it is the output of another scenario");
}

// Without finish(): what HDF5 writes when it closes is not committed.
Hdf5Sink::~Hdf5Sink() {
  const QuietScope quiet;
  groups_.clear();
  file_.close();
}

void Hdf5Sink::commit() {
  require(H5Fflush(file_.id(), H5F_SCOPE_GLOBAL) >= 0);
  hsize_t bytes = 0;
  require(H5Fget_filesize(file_.id(), &bytes) >= 0);
  bytes_.commit(static_cast<std::int64_t>(bytes));
}

std::optional<SinkPosition> Hdf5Sink::position() {
  bytes_.sync();
  return SinkPosition{bytes_.bytes(), static_cast<std::int64_t>(written_)};
}

void Hdf5Sink::kept() {
  if (groups_.empty()) {  // finished
    bytes_.forget_savepoints();
  } else {
    bytes_.savepoint(static_cast<std::int64_t>(written_));
  }
}

void Hdf5Sink::append(const Group& group, std::span<const double> rows, std::size_t count) {
  columns_.resize(count * group.columns);
  for (std::size_t row = 0; row < count; ++row)
    std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(row * width_ + group.first),
                group.columns, columns_.begin() + static_cast<std::ptrdiff_t>(row * group.columns));
  const hsize_t total[] = {written_ + count, group.columns};
  const hsize_t start[] = {written_, 0}, block[] = {count, group.columns};
  require(H5Dset_extent(group.dataset.id(), total) >= 0);
  if (group.columns == 0) return;
  const Handle space = checked(H5Dget_space(group.dataset.id()), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.id());
  require(H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, start, nullptr, block, nullptr) >= 0);
  const Handle memory = checked(H5Screate_simple(rank, block, nullptr), H5Sclose);
  const bool is_date = dates_.is_date(group.first);
  const std::string texts = is_date ? date_texts() : std::string();
  const Handle type = is_date ? date_type() : Handle(H5Tcopy(H5T_NATIVE_DOUBLE), H5Tclose);
  require(H5Dwrite(group.dataset.id(), type.id(), memory.id(), space.id(), H5P_DEFAULT,
                   is_date ? static_cast<const void*>(texts.data()) : columns_.data()) >= 0);
}

// Of the times in columns_.
std::string Hdf5Sink::date_texts() const {
  std::string texts;
  for (const double t : columns_) {
    texts += dates_.text(t);
    texts.resize((texts.size() + date_length - 1) / date_length * date_length);
  }
  return texts;
}

void Hdf5Sink::push(std::span<const double> rows) {
  const QuietScope quiet;
  errno = 0;
  const std::size_t count = rows.size() / width_;
  for (const Group& group : groups_) append(group, rows, count);
  written_ += count;
  commit();
}

void Hdf5Sink::close_with(const std::string& name, const std::vector<std::string>& notes) {
  const QuietScope quiet;
  errno = 0;
  if (!notes.empty()) attach(file_.id(), name.c_str(), notes, false);
}

void Hdf5Sink::finish() {
  const QuietScope quiet;
  errno = 0;
  for (Group& group : groups_) require(group.dataset.close());
  groups_.clear();
  require(H5Fflush(file_.id(), H5F_SCOPE_GLOBAL) >= 0);
  hsize_t bytes = 0;
  require(H5Fget_filesize(file_.id(), &bytes) >= 0 && file_.close());
  bytes_.commit(static_cast<std::int64_t>(bytes));
  bytes_.sync();
  rename_part(part_, path_);
}

std::string group_text(const std::string& name, const std::vector<std::string>& columns) {
  std::string text = name + ":";
  for (const std::string& column : columns) text += " " + column;
  return text;
}

// Every dataset with its columns, by name.
std::vector<std::string> groups_in(hid_t file) {
  std::vector<std::string> groups;
  H5G_info_t info;
  if (H5Gget_info(file, &info) < 0) return groups;
  for (hsize_t i = 0; i < info.nlinks; ++i) {
    char name[256] = {};
    H5Lget_name_by_idx(file, ".", H5_INDEX_NAME, H5_ITER_INC, i, name, sizeof name, H5P_DEFAULT);
    const Handle dataset(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose);
    const std::vector<std::string> columns = attribute_texts(dataset.id(), "columns");
    if (!columns.empty()) groups.push_back(group_text(name, columns));  // or names of columns
  }
  std::sort(groups.begin(), groups.end());
  return groups;
}

Origin origin_of(const std::string& path) {
  const QuietScope quiet;
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  Origin origin;
  if (file.id() < 0) return origin;
  origin.scenario = attribute_texts(file.id(), "scenario");
  for (std::string& note : attribute_texts(file.id(), "notes"))
    if (note.starts_with(file_lead)) origin.files.push_back(std::move(note));
  origin.columns = groups_in(file.id());
  return origin;
}

Origin origin_of(const std::vector<ColumnGroup>& groups, const Provenance& provenance) {
  Origin origin{{provenance.scenario_text}, {}, {}};
  for (const ColumnGroup& group : groups) {
    std::vector<std::string> columns;
    for (const Column& column : group.columns) columns.push_back(column.name);
    if (!columns.empty()) origin.columns.push_back(group_text(group.name, columns));
  }
  std::sort(origin.columns.begin(), origin.columns.end());
  for (const std::string& note : provenance.notes)
    if (note.starts_with(file_lead)) origin.files.push_back(note);
  return origin;
}

// The first rows of a dataset of so many columns; empty where it has not as many.
std::vector<double> first_rows(hid_t file, const std::string& name, std::size_t columns,
                               hsize_t count) {
  const Handle dataset(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (dataset.id() < 0) return {};
  const Handle space(H5Dget_space(dataset.id()), H5Sclose);
  hsize_t size[2] = {0, 1};
  const int rank = H5Sget_simple_extent_ndims(space.id());
  if (rank < 1 || rank > 2 || H5Sget_simple_extent_dims(space.id(), size, nullptr) < 0 ||
      size[0] < count || size[1] != columns)
    return {};
  const hsize_t start[] = {0, 0}, block[] = {count, columns};
  const Handle memory(H5Screate_simple(rank, block, nullptr), H5Sclose);
  std::vector<double> numbers(count * columns);
  const bool good =
      H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, start, nullptr, block, nullptr) >= 0 &&
      H5Dread(dataset.id(), H5T_NATIVE_DOUBLE, memory.id(), space.id(), H5P_DEFAULT,
              numbers.data()) >= 0;
  return good ? numbers : std::vector<double>();
}

std::vector<double> rows_of(const std::string& path, const std::vector<ColumnGroup>& groups,
                            std::int64_t count) {
  const QuietScope quiet;
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  const auto n = static_cast<std::size_t>(count);
  std::size_t width = 0, first = 0;
  for (const ColumnGroup& group : groups) width += group.columns.size();
  std::vector<double> rows(n * width);
  for (const ColumnGroup& group : groups) {
    const std::size_t columns = group.columns.size();
    if (columns == 0) continue;
    if (group.columns.front().is_date) {  // t, which is there already
      for (std::size_t row = 0; row < n; ++row) rows[row * width + first] = rows[row * width];
      ++first;
      continue;
    }
    const std::vector<double> own =
        file.id() < 0 ? std::vector<double>() : first_rows(file.id(), group.name, columns, n);
    if (own.size() != n * columns)
      throw DomainError(printable(path, path.size()) + ": expected " + std::to_string(count) +
                        " rows in " + group.name);
    for (std::size_t row = 0; row < n; ++row)
      for (std::size_t i = 0; i < columns; ++i)
        rows[row * width + first + i] = own[row * columns + i];
    first += columns;
  }
  return rows;
}

}  // namespace

OutputFormat hdf5_format() {
  OutputFormat format("hdf5", ".h5",
                      "HDF5: a dataset for each group of columns; its dimensions are t (or member, "
                      "row, ...) and the names of columns.",
                      [](const SinkRequest& request) {
                        return std::make_unique<Hdf5Sink>(request.path, request.groups,
                                                          request.provenance, request.from,
                                                          dates_of(request));
                      });
  format.label = "HDF5";
  format.needs.file = true;
  format.number_bytes = {8, 8};
  format.difference = [](const std::string& path, const std::vector<ColumnGroup>& groups,
                         const Provenance& provenance) {
    return difference(origin_of(path), origin_of(groups, provenance));
  };
  format.rows = rows_of;
  return format;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
