// SPDX-License-Identifier: MIT
// HDF5 identifiers that close themselves, and HDF5 over a JournaledFile.
#pragma once

#include <hdf5.h>

#include <string>
#include <utility>
#include <vector>

#include "output/detail/journaled_file.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// HDF5 prints its errors unless it is silenced; the caller's choice is put back.
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

// Texts of an attribute, of any length each; none where there is no such attribute.
std::vector<std::string> attribute_texts(hid_t object, const char* name);

// The file access property list that makes HDF5 read and write `file`, which must outlive the HDF5
// file; negative when HDF5 has no memory. What HDF5 flushes waits in `file` for its commit().
hid_t access_to(JournaledFile& file);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
