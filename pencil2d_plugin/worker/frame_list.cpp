#include "worker/frame_list.h"

#include <QRegularExpression>
#include <QStringList>

#include <algorithm>

namespace lampblack
{

namespace
{
constexpr int MaxFrames = 100000;
} // namespace

std::optional<QVector<int>> parseFrames(const QString& text)
{
    static const QRegularExpression range(QStringLiteral("\\A(\\d{1,6})(?:-(\\d{1,6})(?:x(\\d{1,6}))?)?\\z"));
    QVector<int> frames;
    const QStringList parts = text.split(QLatin1Char(','));
    for (const QString& part : parts)
    {
        const QRegularExpressionMatch match = range.match(part);
        const int first = match.captured(1).toInt();
        const int last = match.captured(2).isEmpty() ? first : match.captured(2).toInt();
        const int step = match.captured(3).isEmpty() ? 1 : match.captured(3).toInt();
        if (!match.hasMatch() || last < first || step < 1 ||
            frames.size() + (last - first) / step >= MaxFrames)
        {
            return std::nullopt;
        }
        for (int frame = first; frame <= last; frame += step)
        {
            frames.append(frame);
        }
    }
    std::sort(frames.begin(), frames.end());
    frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
    return frames;
}

QString formatFrames(const QVector<int>& frames)
{
    QStringList parts;
    for (int i = 0; i < frames.size();)
    {
        int end = i + 1;
        const int step = end < frames.size() ? frames[end] - frames[i] : 1;
        while (end < frames.size() && frames[end] - frames[end - 1] == step)
        {
            ++end;
        }
        const bool run = end - i >= (step == 1 ? 2 : 3); // "1,3" is shorter than "1-3x2"
        end = run ? end : i + 1;
        QString part = QString::number(frames[i]);
        if (run)
        {
            part += QLatin1Char('-') + QString::number(frames[end - 1]);
            part += step == 1 ? QString() : QLatin1Char('x') + QString::number(step);
        }
        parts.append(part);
        i = end;
    }
    return parts.join(QLatin1Char(','));
}

} // namespace lampblack
