// What a table of points calls its columns, above its first row.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "engine/core/result.h"

namespace palace {

/// Columns of east, north and up, from 0.
using PointColumns = std::array<std::size_t, 3>;

/// Of "x,y,z", "id Northing Easting Height", "x [m];y [m];z [m];intensity": upper or lower case,
/// units in brackets. Nothing where the line names none of them: prose, or a table whose columns
/// are told by their place. Errors, of what would turn the ground over or make it larger: heights
/// that count downwards, another unit than metres, some of the three but not all, two of one, and
/// names that nobody knows over more than three columns.
///
/// `row_numbers`: numbers in the first row. `is_comment`: of a comment only a line that names all
/// three is one of columns.
Result<std::optional<PointColumns>> ColumnsNamed(const std::string& line, std::size_t row_numbers,
                                                 bool is_comment);

}  // namespace palace
