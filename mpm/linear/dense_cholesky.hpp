#pragma once
// Cholesky's method for the dense matrices of fronts: a few hundred unknowns, often only tens.
#include <cstddef>

namespace softgrain::mpm {

/// Rows that a column needs in storage: products are taken in whole packets and may write so far past the
/// last row. What is there must be finite and means nothing.
std::size_t stored_rows(std::size_t rows);

/// Factors the first `columns` of `rows` x `columns` numbers (columns <= rows, lower triangle) in place; what
/// is above the diagonal is overwritten. False if they are not positive definite.
bool factor_columns(double* a, std::size_t stride, std::size_t rows, std::size_t columns);

/// C = -A B^T for A and B [rows x inner].
void find_product(const double* a, const double* b, std::size_t stride, std::size_t rows, std::size_t inner,
                  double* c, std::size_t c_stride);

/// Its lower triangle in columns [first, last). Up to 3 numbers of a column above the diagonal are
/// overwritten.
void find_lower_product(const double* a, const double* b, std::size_t stride, std::size_t rows,
                        std::size_t inner, double* c, std::size_t c_stride, std::size_t first,
                        std::size_t last);

/// Columns are best divided at multiples of this.
inline constexpr std::size_t panel_columns = 4;

}  // namespace softgrain::mpm
