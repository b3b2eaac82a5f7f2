#pragma once
/* Two-dimensional frictional contact by Siconos/Numerics; its headers need C. */
#ifdef __cplusplus
extern "C" {
#endif

/** w = W r + q for (normal, tangential) contact by contact. W in compressed columns, symmetric. */
struct SiconosProblem {
    int contacts;
    const int *column_start, *row;
    const double* value;
    double *q, *friction;
};

/** Non-smooth Gauss-Seidel from r = 0 until Siconos' error is below `tolerance`. Returns its code, 0 if done.
 */
int siconos_solve(const struct SiconosProblem* problem, double tolerance, int max_iterations, double* r,
                  int* iterations);

/** Siconos' error of an answer: the norm of its natural map, not scaled. */
double siconos_error(const struct SiconosProblem* problem, double* r);

#ifdef __cplusplus
}
#endif
