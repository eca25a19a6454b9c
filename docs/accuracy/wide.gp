# docs/gallery/style.gp for two or three plots side by side. SPDX-License-Identifier: GPL-3.0-or-later
load "docs/gallery/style.gp"
set terminal pngcairo size 860,340 font "DejaVu Sans,8.5" enhanced linewidth 1.2 background "#ffffff"
set logscale xy
set format y "10^{%T}"
