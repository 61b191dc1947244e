// SPDX-License-Identifier: MIT
// HDF5 attributes, and the file driver that writes over a JournaledFile.
#include "output/detail/hdf5_handle.hpp"

#include <algorithm>
#include <cstring>
#include <functional>
#include <new>

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

std::vector<std::string> attribute_texts(hid_t object, const char* name) {
  if (H5Aexists(object, name) <= 0) return {};
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(attribute.id()), H5Tclose);
  const Handle space(H5Aget_space(attribute.id()), H5Sclose);
  if (H5Tis_variable_str(type.id()) <= 0) return {};
  const hssize_t count = H5Sget_simple_extent_npoints(space.id());
  std::vector<char*> pointers(static_cast<std::size_t>(count > 0 ? count : 0), nullptr);
  if (pointers.empty() || H5Aread(attribute.id(), type.id(), pointers.data()) < 0) return {};
  std::vector<std::string> texts;
  for (const char* text : pointers) texts.emplace_back(text == nullptr ? "" : text);
  H5Dvlen_reclaim(type.id(), space.id(), H5P_DEFAULT, pointers.data());
  return texts;
}

namespace {

// A file of HDF5's driver over a JournaledFile. HDF5 changes its file in place, and one that is
// killed between two writes leaves a file that it cannot read; and it crashes when a write fails.
// Here it writes to memory, and its file changes between two states that it can read.
struct OpenFile {
  H5FD_t base;  // first, as HDF5 knows no more of it
  JournaledFile* file;
  haddr_t allocated;
  haddr_t end;
};
using Chosen = JournaledFile*;  // what the property list carries

OpenFile& of(H5FD_t* file) { return *reinterpret_cast<OpenFile*>(file); }
const OpenFile& of(const H5FD_t* file) { return *reinterpret_cast<const OpenFile*>(file); }

H5FD_t* opened(const char*, unsigned flags, hid_t access, haddr_t) {
  const void* info = H5Pget_driver_info(access);
  if (info == nullptr) return nullptr;
  auto* const file = new (std::nothrow) OpenFile{};
  if (file == nullptr) return nullptr;
  file->file = *static_cast<const Chosen*>(info);
  file->end = (flags & H5F_ACC_TRUNC) != 0 ? 0 : static_cast<haddr_t>(file->file->bytes());
  return &file->base;
}

herr_t closed(H5FD_t* file) {
  delete &of(file);
  return 0;
}

int compared(const H5FD_t* a, const H5FD_t* b) {
  const JournaledFile* const x = of(a).file;
  const JournaledFile* const y = of(b).file;
  return std::less<>()(x, y) ? -1 : (x == y ? 0 : 1);
}

herr_t features(const H5FD_t*, unsigned long* flags) {
  *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
           H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return 0;
}

haddr_t allocated(const H5FD_t* file, H5FD_mem_t) { return of(file).allocated; }

herr_t allocate(H5FD_t* file, H5FD_mem_t, haddr_t bytes) {
  of(file).allocated = bytes;
  return 0;
}

haddr_t end(const H5FD_t* file, H5FD_mem_t) { return of(file).end; }

herr_t read(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t offset, std::size_t size, void* out) {
  return of(file).file->read(offset, {static_cast<char*>(out), size}) ? 0 : -1;
}

herr_t write(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t offset, std::size_t size, const void* bytes) {
  OpenFile& f = of(file);
  if (!f.file->write(offset, {static_cast<const char*>(bytes), size})) return -1;
  f.end = std::max(f.end, offset + size);
  return 0;
}

herr_t truncate(H5FD_t* file, hid_t, hbool_t) {
  of(file).end = of(file).allocated;
  return 0;
}

H5FD_class_t driver_class() {
  H5FD_class_t c{};
#ifdef H5FD_CLASS_VERSION  // from HDF5 1.14 on
  c.version = H5FD_CLASS_VERSION;
  c.value = 511;  // 256 to 511 are of no registered driver
#endif
  c.name = "polhode";
  c.maxaddr = haddr_t{1} << 62;
  c.fc_degree = H5F_CLOSE_WEAK;
  c.fapl_size = sizeof(Chosen);
  c.open = opened;
  c.close = closed;
  c.cmp = compared;
  c.query = features;
  c.get_eoa = allocated;
  c.set_eoa = allocate;
  c.get_eof = end;
  c.read = read;
  c.write = write;
  c.truncate = truncate;
  const H5FD_mem_t types[] = H5FD_FLMAP_DICHOTOMY;
  std::memcpy(c.fl_map, types, sizeof types);
  return c;
}

}  // namespace

hid_t access_to(JournaledFile& file) {
  static const H5FD_class_t driver = driver_class();
  static const hid_t id = H5FDregister(&driver);
  if (id < 0) return -1;
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  const Chosen chosen = &file;
  if (access >= 0 && H5Pset_driver(access, id, &chosen) < 0) {
    H5Pclose(access);
    return -1;
  }
  return access;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
