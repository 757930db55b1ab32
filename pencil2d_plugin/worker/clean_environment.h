// The environment in which our Python runs.
#pragma once

#include <QProcessEnvironment>

namespace lampblack
{

/// The variables that a worker needs. Others could change which Python modules or libraries it loads.
/// `folder` is for its temporary files.
QProcessEnvironment cleanEnvironment(const QString& folder);

} // namespace lampblack
