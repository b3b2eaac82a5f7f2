#pragma once
// The frictionless inner loop, several rows at a time where the processor can. Knows no Eigen.

namespace softgrain::contact_sweep {

/// Rows that are relaxed together; they touch no disc twice.
constexpr int batch_rows = 4;

/// Columns of ContactRows and the velocities of the discs, points as x, y.
struct FrictionlessRows {
    const int *i, *j;
    const double *direction, *gap_speed, *share;
    double* normal;
    double* v;
};

/// Relaxes the rows [first, last), a whole number of batches. Returns the largest |change| of an impulse.
double relax_batches(const FrictionlessRows& rows, double omega, int first, int last);

/// Largest number of rows in a vector on this processor, and as built: 1, 2 or 4.
int rows_in_a_vector();
/// relax_batches with that many rows in a vector, at most rows_in_a_vector(). The same bits for any.
double relax_batches_by(int rows_in_vector, const FrictionlessRows& rows, double omega, int first, int last);

}  // namespace softgrain::contact_sweep
