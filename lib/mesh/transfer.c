/* placeholder until the tiles */
#include "mesh/transfer_axis.h"

int pm_spread(const struct pm_transfer *t, size_t n, const double *const x[], const double *const strength[], double *const mesh[],
	struct pm_strays *strays)
{
	return pm_spread_plain(t, n, x, strength, mesh, strays);
}

int pm_gather(const struct pm_transfer *t, size_t n, const double *const x[], const double *const mesh[], const double *factor,
	double *const out[], struct pm_strays *strays)
{
	return pm_gather_plain(t, n, x, mesh, factor, out, strays);
}
