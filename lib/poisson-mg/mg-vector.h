/* Vectors of one register of the numbers of a hierarchy. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_POISSON_MG_MG_VECTOR_H
#define PM_POISSON_MG_MG_VECTOR_H

#define PM_SIMD_NARROW
#include "base/simd-single.h"
#include "poisson-mg/mg-number.h"

#ifdef MG_SINGLE
enum { W = PM_SINGLE_WIDTH };
typedef pm_single mg_vector;
#define mg_load pm_single_load
#define mg_store pm_single_store
#define mg_shift_up pm_single_shift_up
#define mg_shift_down pm_single_shift_down
#define mg_even pm_single_even
#define mg_odd pm_single_odd
#define mg_zip_low pm_single_zip_low
#define mg_zip_high pm_single_zip_high
#define mg_masked pm_single_masked
#else
enum { W = PM_SIMD_WIDTH };
typedef pm_simd mg_vector;
#define mg_load pm_simd_load
#define mg_store pm_simd_store
#define mg_shift_up pm_simd_shift_up
#define mg_shift_down pm_simd_shift_down
#define mg_even pm_simd_even
#define mg_odd pm_simd_odd
#define mg_zip_low pm_simd_zip_low
#define mg_zip_high pm_simd_zip_high
#define mg_masked pm_simd_masked
#endif

#endif
