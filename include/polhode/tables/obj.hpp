// SPDX-License-Identifier: MIT
// Facet shapes from and to Wavefront OBJ files.
//
// Units       those of the file: OBJ has none.
// Domain      text of at most 256 MB. `v x y z` and `f i j k ...` are read: indices from 1, or
//             negative, counted back from the last vertex; i, i/t, i//n and i/t/n. A polygon
//             becomes a fan of triangles about its first corner where that fills it, otherwise the
//             ears that are cut off one by one (at most 4096 corners). What else OBJ knows
//             (normals, textures, groups, materials, curves) is skipped. Comments, CRLF, a byte
//             order mark, lines continued by a backslash; files packed by gzip.
// Accuracy    the nearest double; a shape that is written reads back bit for bit.
// Errors      DomainError in one line, "FILE:LINE: ...": text for a number, one not finite, an
//             index 0 or of no vertex, a facet with fewer than three corners or with no area, a
//             face that crosses itself or is not flat (to a tenth of its size), a word that OBJ
//             does not know; "FILE: ..." for a file that cannot be read, is too large, or has no
//             facets. A mesh with holes is read: FacetShape::open_edge names it.
// Cost        some 100 ns per line.
#pragma once

#include <string>
#include <string_view>

#include "polhode/shape/facet_shape.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

shape::FacetShape read_obj(const std::string& path);
// `name` stands for the file in messages.
shape::FacetShape shape_from_obj(std::string_view text, const std::string& name);
// The file of a shape, one line for each vertex and facet.
std::string obj_text(const shape::FacetShape& shape);

}  // namespace io
}  // namespace v0
}  // namespace polhode
