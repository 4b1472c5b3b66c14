// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_CURVE_H_
#define ICPSCAPE_APPS_FLAGS_CURVE_H_

#include <string>

#include "icpscape/landscape/curve.h"

namespace icpscape {

/// The path, what is evaluated along it, and what is drawn: --u_min, --u_max, --samples, --path,
/// --association, --frozen_u and --patch_offset. Throws UsageError.
CurveOptions CurveFromFlags();
PathKind PathKindFromFlags();

/// --column, by its name in the table. Throws UsageError.
CurveColumn ColumnFromFlags();

/// "re-associated at every pose" or "matches frozen at u = 1", for the figure's title.
std::string AssociationText();

/// Throws UsageError where iterates of the minimiser would not lie on the curve: it must be the
/// curve of what is minimised.
void CheckCurveOfIterates();

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_CURVE_H_
