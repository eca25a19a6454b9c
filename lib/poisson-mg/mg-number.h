/* The numbers of a hierarchy: double, or single in the files that the build compiles a second time with MG_SINGLE (Makefile, mg_twice), where everything
 * that has a name outside its file gets another. mg-single.h is what the two share. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_POISSON_MG_MG_NUMBER_H
#define PM_POISSON_MG_MG_NUMBER_H

#include <stdint.h>

#ifdef MG_SINGLE
typedef float mg_number;
typedef int32_t mg_mask;
enum { mg_lanes = 16 }; /* of the widest register */
#define mg_level mg_level_single
#define pm_mg pm_mg_single
#define pm_mg_level_finest pm_mg_single_level_finest
#define pm_mg_level_coarser pm_mg_single_level_coarser
#define pm_mg_level_whole pm_mg_single_level_whole
#define pm_mg_level_free pm_mg_single_level_free
#define pm_mg_beside pm_mg_single_beside
#define pm_mg_beside_own pm_mg_single_beside_own
#define pm_mg_total pm_mg_single_total
#define pm_mg_most pm_mg_single_most
#define pm_mg_hand_over pm_mg_single_hand_over
#define pm_mg_take_back pm_mg_single_take_back
#define pm_mg_whole_cycles pm_mg_single_whole_cycles
#define pm_mg_whole_pyramid pm_mg_single_whole_pyramid
#define pm_mg_relax_plain pm_mg_single_relax_plain
#define pm_mg_relax_plane pm_mg_single_relax_plane
#define pm_mg_residual_row pm_mg_single_residual_row
#define pm_mg_residual_of pm_mg_single_residual_of
#define pm_mg_compact_init pm_mg_single_compact_init
#define pm_mg_colour_plane pm_mg_single_colour_plane
#define pm_mg_jacobi_plane pm_mg_single_jacobi_plane
#define pm_mg_keep_plane pm_mg_single_keep_plane
#define pm_mg_compact_residual pm_mg_single_compact_residual
#define pm_mg_compact_source pm_mg_single_compact_source
#define pm_mg_add_row pm_mg_single_add_row
#define pm_mg_fold_row pm_mg_single_fold_row
#define pm_mg_gather pm_mg_single_gather
#define pm_mg_correct_plane pm_mg_single_correct_plane
#define pm_mg_restrict pm_mg_single_restrict
#define pm_mg_pyramid pm_mg_single_pyramid
#define pm_mg_lagrange pm_mg_single_lagrange
#define pm_mg_full_tables pm_mg_single_full_tables
#define pm_mg_interpolate_plane pm_mg_single_interpolate_plane
#define pm_mg_restrict_source pm_mg_single_restrict_source
#define pm_mg_sweep pm_mg_single_sweep
#define pm_mg_squares pm_mg_single_squares
#define pm_mg_unknowns pm_mg_single_unknowns
#define pm_mg_solve_coarsest pm_mg_single_solve_coarsest
#define pm_mg_cycle_down pm_mg_single_cycle_down
#define pm_mg_cycle_up pm_mg_single_cycle_up
#define pm_mg_start_sources pm_mg_single_start_sources
#define pm_mg_start_full pm_mg_single_start_full
#define pm_mg_build pm_mg_single_build
#define pm_mg_room pm_mg_single_room
#define pm_mg_demolish pm_mg_single_demolish
#else
typedef double mg_number;
typedef int64_t mg_mask;
enum { mg_lanes = 8 };
#endif

#endif
