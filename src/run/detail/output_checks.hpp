// SPDX-License-Identifier: MIT
// Checks of the paths of outputs: none may be a file that a run reads, or the same as another.
#pragma once

#include <span>
#include <string>

#include "polhode/scenario/document.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// Whether a path is a file or can become one: not -, no pipe, device or folder.
bool is_file(const std::string& path);

// Throws DomainError where one of these paths is a file that the scenario reads, under whatever
// name, or where two of them are the same file.
void require_own_files(const Document& document, std::span<const std::string> paths);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
