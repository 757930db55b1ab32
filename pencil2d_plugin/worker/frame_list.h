// Frame lists such as "1-20x2,25" (SPEC 8, render).
#pragma once

#include <QString>
#include <QVector>

#include <optional>

namespace lampblack
{

/// The frames of a list, rising, each once; nothing if it is malformed or names over 100,000.
std::optional<QVector<int>> parseFrames(const QString& text);

/// The shortest list of ranges and steps for rising frames, as a greedy reader finds it.
QString formatFrames(const QVector<int>& frames);

} // namespace lampblack
