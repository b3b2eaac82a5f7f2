#include "mpm/linear/dense_cholesky.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace softgrain::mpm {
namespace {

using Packet = Eigen::internal::packet_traits<double>::type;
constexpr std::size_t width = Eigen::internal::packet_traits<double>::size;
/// Packets of rows in a block that is kept in registers.
constexpr std::size_t most_packets = 3;

enum class Into { sum, new_numbers };

/// C -= A B^T, or C = -A B^T, for `packets` packets of rows of A and `columns` rows of B.
template <Into into, std::size_t packets, std::size_t columns>
void subtract_block(const double* a, const double* b, std::size_t stride, std::size_t inner, double* c,
                    std::size_t c_stride) {
    using namespace Eigen::internal;
    Packet sum[packets][columns];
    for (std::size_t i = 0; i < packets; ++i)
        for (std::size_t j = 0; j < columns; ++j) sum[i][j] = pset1<Packet>(0.0);
    for (std::size_t k = 0; k < inner; ++k, a += stride, b += stride) {
        Packet of_a[packets];
        for (std::size_t i = 0; i < packets; ++i) of_a[i] = ploadu<Packet>(a + i * width);
        for (std::size_t j = 0; j < columns; ++j) {
            const Packet of_b = pset1<Packet>(b[j]);
            for (std::size_t i = 0; i < packets; ++i) sum[i][j] = pmadd(of_a[i], of_b, sum[i][j]);
        }
    }
    for (std::size_t j = 0; j < columns; ++j)
        for (std::size_t i = 0; i < packets; ++i) {
            double* const to = c + j * c_stride + i * width;
            if constexpr (into == Into::sum)
                pstoreu(to, psub(ploadu<Packet>(to), sum[i][j]));
            else
                pstoreu(to, pnegate(sum[i][j]));
        }
}

/// The same for any number of rows.
template <Into into, std::size_t columns>
void subtract_panel(const double* a, const double* b, std::size_t stride, std::size_t rows, std::size_t inner,
                    double* c, std::size_t c_stride) {
    std::size_t row = 0;
    for (; row + (most_packets - 1) * width < rows; row += most_packets * width)
        subtract_block<into, most_packets, columns>(a + row, b, stride, inner, c + row, c_stride);
    if (row + width < rows)
        subtract_block<into, 2, columns>(a + row, b, stride, inner, c + row, c_stride);
    else if (row < rows)
        subtract_block<into, 1, columns>(a + row, b, stride, inner, c + row, c_stride);
}

template <Into into>
void subtract_panel(std::size_t columns, const double* a, const double* b, std::size_t stride,
                    std::size_t rows, std::size_t inner, double* c, std::size_t c_stride) {
    switch (columns) {
        case 4:
            return subtract_panel<into, 4>(a, b, stride, rows, inner, c, c_stride);
        case 3:
            return subtract_panel<into, 3>(a, b, stride, rows, inner, c, c_stride);
        case 2:
            return subtract_panel<into, 2>(a, b, stride, rows, inner, c, c_stride);
        default:
            return subtract_panel<into, 1>(a, b, stride, rows, inner, c, c_stride);
    }
}

/// Factors a panel of few columns that all columns before it are already taken from.
bool factor_panel(double* a, std::size_t stride, std::size_t rows, std::size_t columns) {
    using namespace Eigen::internal;
    for (std::size_t j = 0; j < columns; ++j) {
        double* const own = a + j * stride;
        const double pivot = own[j];
        if (!(pivot > 0.0)) return false;
        const double root = std::sqrt(pivot);
        own[j] = root;
        const Packet scale = pset1<Packet>(1.0 / root);
        for (std::size_t i = j + 1; i < rows; i += width)
            pstoreu(own + i, pmul(ploadu<Packet>(own + i), scale));
        for (std::size_t l = j + 1; l < columns; ++l) {
            double* const other = a + l * stride;
            const Packet by = pset1<Packet>(-own[l]);
            for (std::size_t i = l; i < rows; i += width)
                pstoreu(other + i, pmadd(ploadu<Packet>(own + i), by, ploadu<Packet>(other + i)));
        }
    }
    return true;
}

}  // namespace

std::size_t stored_rows(std::size_t rows) {
    return rows + width - 1;
}

bool factor_columns(double* a, std::size_t stride, std::size_t rows, std::size_t columns) {
    for (std::size_t j = 0; j < columns; j += panel_columns) {
        const std::size_t count = std::min(panel_columns, columns - j);
        double* const own = a + j * stride + j;
        subtract_panel<Into::sum>(count, a + j, a + j, stride, rows - j, j, own, stride);
        if (!factor_panel(own, stride, rows - j, count)) return false;
    }
    return true;
}

void find_product(const double* a, const double* b, std::size_t stride, std::size_t rows, std::size_t inner,
                  double* c, std::size_t c_stride) {
    for (std::size_t j = 0; j < rows; j += panel_columns)
        subtract_panel<Into::new_numbers>(std::min(panel_columns, rows - j), a, b + j, stride, rows, inner,
                                          c + j * c_stride, c_stride);
}

void find_lower_product(const double* a, const double* b, std::size_t stride, std::size_t rows,
                        std::size_t inner, double* c, std::size_t c_stride, std::size_t first,
                        std::size_t last) {
    for (std::size_t j = first; j < last; j += panel_columns)
        subtract_panel<Into::new_numbers>(std::min(panel_columns, last - j), a + j, b + j, stride, rows - j,
                                          inner, c + j * c_stride + j, c_stride);
}

}  // namespace softgrain::mpm
