#include "siconos_fc2d.h"

#include <NonSmoothDrivers.h>
#include <NumericsMatrix.h>
#include <SolverOptions.h>
#include <SparseBlockMatrix.h>
#include <fc2d_Solvers.h>
#include <fc2d_compute_error.h>
#include <stdlib.h>

/* W in blocks of two by two, what the sparse Gauss-Seidel takes. */
static NumericsMatrix* blocks_of(const struct SiconosProblem* problem) {
    const int size = 2 * problem->contacts;
    NumericsMatrix* sparse = NM_create(NM_SPARSE, size, size);
    NM_triplet_alloc(sparse, problem->column_start[size]);
    for (int column = 0; column < size; ++column)
        for (int k = problem->column_start[column]; k < problem->column_start[column + 1]; ++k)
            NM_entry(sparse, problem->row[k], column, problem->value[k]);
    SparseBlockStructuredMatrix* blocks = SBM_new();
    SBM_from_csparse(2, NM_csc(sparse), blocks);
    NM_free(sparse);
    return NM_new_SBM(size, size, blocks);
}

static FrictionContactProblem with_matrix(const struct SiconosProblem* problem) {
    FrictionContactProblem result = {2, problem->contacts, blocks_of(problem), problem->q, problem->friction};
    return result;
}

int siconos_solve(const struct SiconosProblem* problem, double tolerance, int max_iterations, double* r,
                  int* iterations) {
    FrictionContactProblem contact = with_matrix(problem);
    SolverOptions* options = solver_options_create(SICONOS_FRICTION_2D_NSGS);
    options->dparam[SICONOS_DPARAM_TOL] = tolerance;
    options->iparam[SICONOS_IPARAM_MAX_ITER] = max_iterations;
    double* w = calloc(2 * (size_t)problem->contacts, sizeof(double));
    for (int k = 0; k < 2 * problem->contacts; ++k) r[k] = 0.0;
    const int code = fc2d_driver(&contact, r, w, options);
    *iterations = options->iparam[SICONOS_IPARAM_ITER_DONE];
    free(w);
    solver_options_delete(options); /* 4.4 keeps the 120 bytes of the struct itself */
    NM_free(contact.M);
    return code;
}

double siconos_error(const struct SiconosProblem* problem, double* r) {
    FrictionContactProblem contact = with_matrix(problem);
    double* w = calloc(2 * (size_t)problem->contacts, sizeof(double));
    double error = 0.0;
    fc2d_compute_error(&contact, r, w, 1.0, 1.0, &error);
    free(w);
    NM_free(contact.M);
    return error;
}
