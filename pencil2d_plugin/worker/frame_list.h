// Frame lists such as "1-20x2,25" (SPEC 8, render).
#pragma once

#include <QString>
#include <QVector>

#include <optional>

namespace lampblack
{

/// The frames of a list in rising order, each once. No value if it is malformed or has over 100,000 frames.
std::optional<QVector<int>> parseFrames(const QString& text);

/// A short list of ranges and steps for frames in rising order, found greedily.
QString formatFrames(const QVector<int>& frames);

} // namespace lampblack
