// SPDX-License-Identifier: MIT
#include "output/detail/hdf5_handle.hpp"

namespace polhode {
inline namespace v0 {
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

}  // namespace detail
}  // namespace v0
}  // namespace polhode
