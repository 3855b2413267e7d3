// SPDX-License-Identifier: MIT
// The one place where the version is written.
#ifndef BASE_VERSION_H
#define BASE_VERSION_H

#define QIPOV_VERSION "1.0.0"

#endif
