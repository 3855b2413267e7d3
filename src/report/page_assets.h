// SPDX-License-Identifier: MIT
// The style and the script of the pages, as text for <style> and <script>.
#ifndef REPORT_PAGE_ASSETS_H
#define REPORT_PAGE_ASSETS_H

extern const char page_style[];
extern const char compare_script[];

#endif
