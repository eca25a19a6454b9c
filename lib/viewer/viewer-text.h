/* page.html, page.css and all *.js of this directory, put together by the build (Makefile, the table viewer-text). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_VIEWER_TEXT_H
#define PM_VIEWER_TEXT_H

extern const char pm_viewer_html[], pm_viewer_css[], pm_viewer_js[];

#endif
