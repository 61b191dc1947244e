// SPDX-License-Identifier: MIT
// HDF5: one dataset per column group, units and provenance as attributes, flushed block by block.
#include <fcntl.h>
#include <hdf5.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "io/detail/part_file.hpp"
#include "io/detail/sinks.hpp"
#include "io/detail/values.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr hsize_t rows_per_chunk = 1024;
// More than the headers, attributes and index nodes that one dataset can grow by in one block.
constexpr std::size_t metadata_bytes = std::size_t{64} << 10;

// HDF5 prints its errors unless told otherwise; the caller's choice is put back.
class QuietScope {
 public:
  QuietScope() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~QuietScope() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  QuietScope(const QuietScope&) = delete;
  QuietScope& operator=(const QuietScope&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

// An HDF5 identifier with the function that closes it.
class Handle {
 public:
  Handle(hid_t id, herr_t (*closer)(hid_t)) : id_(id), close_(closer) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&&) = delete;
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { close(); }

  hid_t id() const { return id_; }
  bool close() { return id_ < 0 || close_(std::exchange(id_, -1)) >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

// HDF5 1.10 crashes when its own writes fail, and leaves a file that it cannot read. So the disk
// space of a block is reserved before HDF5 sees the block, and that of the head before it makes the
// file.
class Reserve {
 public:
  Reserve(const std::string& part, std::size_t head)
      : part_(part),
        descriptor_(::open(part.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
    if (descriptor_ < 0) throw DomainError(write_failure(part, errno));
    try {
      extend(0, head);
    } catch (...) {
      ::close(descriptor_);
      throw;
    }
  }
  ~Reserve() { ::close(descriptor_); }
  Reserve(const Reserve&) = delete;
  Reserve& operator=(const Reserve&) = delete;

  void extend(hsize_t used, std::size_t more) const {
    const int error_number =
        ::posix_fallocate(descriptor_, static_cast<off_t>(used), static_cast<off_t>(more));
    if (error_number == 0) return;
    cut(used);  // where it is emulated, it has filled the disk
    throw OutputError(write_failure(part_, error_number));
  }
  bool cut(hsize_t used) const {
    return ::ftruncate(descriptor_, static_cast<off_t>(used)) == 0 && ::fsync(descriptor_) == 0;
  }

 private:
  std::string part_;
  int descriptor_;
};

// What the file needs before its first row.
std::size_t head_bytes(const std::vector<ColumnGroup>& groups, const Provenance& provenance) {
  std::size_t text = provenance.scenario_text.size() + provenance.title.size();
  for (const auto* list : {&provenance.notes, &provenance.citations})
    for (const std::string& line : *list) text += line.size();
  return 2 * text + (groups.size() + 1) * metadata_bytes;
}

class Hdf5Sink : public Sink {
 public:
  Hdf5Sink(const std::string& path, const std::vector<ColumnGroup>& groups,
           const Provenance& provenance);
  ~Hdf5Sink() override;
  void push(std::span<const double> rows) override;
  void finish() override;

 private:
  struct Group {
    Handle dataset;
    std::size_t first;  // column in a row
    std::size_t columns;
  };
  void require(bool good) const;
  Handle checked(hid_t id, herr_t (*close)(hid_t)) const;
  Handle created_file() const;
  Handle created_dataset(const ColumnGroup& group) const;
  void attach(hid_t object, const char* name, const std::vector<std::string>& texts, bool scalar);
  void append(const Group& group, std::span<const double> rows, std::size_t count);
  hsize_t size() const;

  std::string path_;
  std::string part_;
  Reserve reserve_;
  Handle file_;
  std::vector<Group> groups_;
  std::size_t width_ = 0;
  hsize_t written_ = 0;
  std::vector<double> columns_;
};

std::string regular_part_path(const std::string& path) {
  std::string part = part_path(path);
  if (part == path)
    throw DomainError(printable(path, path.size()) + ": is not a regular file; HDF5 needs one");
  return part;
}

void Hdf5Sink::require(bool good) const {
  if (!good) throw OutputError(write_failure(part_, errno == 0 ? EIO : errno));
}

Handle Hdf5Sink::checked(hid_t id, herr_t (*close)(hid_t)) const {
  require(id >= 0);
  return {id, close};
}

Handle Hdf5Sink::created_file() const {
  const QuietScope quiet;
  errno = 0;
  const Handle creation = checked(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  require(H5Pset_obj_track_times(creation.id(), false) >= 0);
  const hid_t id = H5Fcreate(part_.c_str(), H5F_ACC_TRUNC, creation.id(), H5P_DEFAULT);
  if (id < 0) throw DomainError(write_failure(part_, errno == 0 ? EIO : errno));
  return {id, H5Fclose};
}

Handle Hdf5Sink::created_dataset(const ColumnGroup& group) const {
  const bool flat = group.columns.size() == 1 && group.name == "t";
  const int rank = flat ? 1 : 2;
  const hsize_t columns = group.columns.size();
  const hsize_t now[] = {0, columns}, most[] = {H5S_UNLIMITED, columns};
  const hsize_t chunk[] = {rows_per_chunk, columns};
  const Handle space = checked(H5Screate_simple(rank, now, most), H5Sclose);
  const Handle creation = checked(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  require(H5Pset_chunk(creation.id(), rank, chunk) >= 0 &&
          H5Pset_obj_track_times(creation.id(), false) >= 0);
  return checked(H5Dcreate2(file_.id(), group.name.c_str(), H5T_IEEE_F64LE, space.id(), H5P_DEFAULT,
                            creation.id(), H5P_DEFAULT),
                 H5Dclose);
}

// Texts of any length: variable-length UTF-8, which h5py reads as str.
void Hdf5Sink::attach(hid_t object, const char* name, const std::vector<std::string>& texts,
                      bool scalar) {
  std::vector<const char*> pointers;
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  const hsize_t count = pointers.size();
  const Handle type = checked(H5Tcopy(H5T_C_S1), H5Tclose);
  require(H5Tset_size(type.id(), H5T_VARIABLE) >= 0 && H5Tset_cset(type.id(), H5T_CSET_UTF8) >= 0);
  const Handle space =
      checked(scalar ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr), H5Sclose);
  const Handle attribute =
      checked(H5Acreate2(object, name, type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  require(H5Awrite(attribute.id(), type.id(), pointers.data()) >= 0);
}

Hdf5Sink::Hdf5Sink(const std::string& path, const std::vector<ColumnGroup>& groups,
                   const Provenance& provenance)
    : path_(path),
      part_(regular_part_path(path)),
      reserve_(part_, head_bytes(groups, provenance)),
      file_(created_file()) {
  const QuietScope quiet;
  reserve_.extend(size(), head_bytes(groups, provenance));
  for (const ColumnGroup& group : groups) {
    if (group.columns.empty()) continue;
    groups_.push_back({created_dataset(group), width_, group.columns.size()});
    width_ += group.columns.size();
    std::vector<std::string> names, units;
    for (const Column& column : group.columns) {
      names.push_back(column.name);
      units.push_back(column.unit);
    }
    attach(groups_.back().dataset.id(), "columns", names, false);
    attach(groups_.back().dataset.id(), "units", units, false);
  }
  attach(file_.id(), "polhode", {provenance.version}, true);
  attach(file_.id(), "title", {provenance.title}, true);
  attach(file_.id(), "scenario_name", {provenance.scenario_name}, true);
  attach(file_.id(), "scenario", {provenance.scenario_text}, true);
  attach(file_.id(), "notes", provenance.notes, false);
  attach(file_.id(), "citations", provenance.citations, false);
  require(H5Fflush(file_.id(), H5F_SCOPE_GLOBAL) >= 0);
}

Hdf5Sink::~Hdf5Sink() {
  const QuietScope quiet;
  groups_.clear();
  file_.close();
}

hsize_t Hdf5Sink::size() const {
  hsize_t bytes = 0;
  require(H5Fget_filesize(file_.id(), &bytes) >= 0);
  return bytes;
}

void Hdf5Sink::append(const Group& group, std::span<const double> rows, std::size_t count) {
  columns_.clear();
  for (std::size_t row = 0; row < count; ++row)
    for (std::size_t i = 0; i < group.columns; ++i)
      columns_.push_back(rows[row * width_ + group.first + i]);
  const hsize_t total[] = {written_ + count, group.columns};
  const hsize_t start[] = {written_, 0}, block[] = {count, group.columns};
  require(H5Dset_extent(group.dataset.id(), total) >= 0);
  const Handle space = checked(H5Dget_space(group.dataset.id()), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.id());
  require(H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, start, nullptr, block, nullptr) >= 0);
  const Handle memory = checked(H5Screate_simple(rank, block, nullptr), H5Sclose);
  require(H5Dwrite(group.dataset.id(), H5T_NATIVE_DOUBLE, memory.id(), space.id(), H5P_DEFAULT,
                   columns_.data()) >= 0);
}

void Hdf5Sink::push(std::span<const double> rows) {
  const QuietScope quiet;
  errno = 0;
  const std::size_t count = rows.size() / width_;
  reserve_.extend(
      size(), (count + rows_per_chunk) * width_ * sizeof(double) + groups_.size() * metadata_bytes);
  for (const Group& group : groups_) append(group, rows, count);
  written_ += count;
  require(H5Fflush(file_.id(), H5F_SCOPE_GLOBAL) >= 0);
}

void Hdf5Sink::finish() {
  const QuietScope quiet;
  errno = 0;
  for (Group& group : groups_) require(group.dataset.close());
  require(H5Fflush(file_.id(), H5F_SCOPE_GLOBAL) >= 0);
  const hsize_t used = size();
  require(file_.close() && reserve_.cut(used));
  rename_part(part_, path_);
}

}  // namespace

std::unique_ptr<Sink> hdf5_sink(const std::string& path, const std::vector<ColumnGroup>& groups,
                                const Provenance& provenance,
                                const std::optional<SinkPosition>& from) {
  if (from) throw DomainError(printable(path, path.size()) + ": cannot be continued");
  return std::make_unique<Hdf5Sink>(path, groups, provenance);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
