/* The main of programs that are built for several levels of x86-64 (make DISPATCH=1): takes the highest that the processor has, or that PM_INSTRUCTIONS
 * (x86-64, x86-64-v3) allows. Levels: System V ABI, AMD64 supplement, 2023. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

int main_x86_64(int argc, char **argv);
int main_x86_64_v3(int argc, char **argv);
int main_x86_64_v4(int argc, char **argv);

int main(int argc, char **argv)
{
	const char *most = getenv("PM_INSTRUCTIONS");
	__builtin_cpu_init();
	bool v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("fma");
	bool v4 = v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd") &&
		__builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
	if (most && !strcmp(most, "x86-64"))
		v3 = v4 = false;
	if (most && !strcmp(most, "x86-64-v3"))
		v4 = false;
	return (v4 ? main_x86_64_v4 : v3 ? main_x86_64_v3 : main_x86_64)(argc, argv);
}
