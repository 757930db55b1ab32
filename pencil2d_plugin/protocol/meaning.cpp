#include "protocol/meaning.h"

#include <cmath>
#include <vector>

namespace lampblack::protocol
{
namespace
{

constexpr int MaxFrames = 100000;
constexpr std::size_t FrameNumbers = 1000000;

QString cameraFault(const QTransform& camera)
{
    const double area = camera.m11() * camera.m22() - camera.m21() * camera.m12();
    return std::abs(area) < 1e-6 ? QStringLiteral("the camera matrix has no inverse") : QString();
}

/// `list` matches the pattern of Render's frames: "first", "first-last" or "first-lastxstep", by commas.
QString framesFault(const QString& list)
{
    std::vector<bool> named(FrameNumbers, false);
    int count = 0;
    const QStringList ranges = list.split(QLatin1Char(','));
    for (const QString& range : ranges)
    {
        const int first = range.section(QLatin1Char('-'), 0, 0).toInt();
        const QString rest = range.section(QLatin1Char('-'), 1);
        const int last = rest.isEmpty() ? first : rest.section(QLatin1Char('x'), 0, 0).toInt();
        const int step = rest.contains(QLatin1Char('x')) ? rest.section(QLatin1Char('x'), 1).toInt() : 1;
        if (last < first || step < 1)
        {
            return QStringLiteral("frames that run backwards or stand still");
        }
        if ((last - first) / step + 1 + count > MaxFrames)
        {
            return QStringLiteral("more than %1 frames").arg(MaxFrames);
        }
        for (int frame = first; frame <= last; frame += step)
        {
            const auto at = static_cast<std::size_t>(frame);
            count += named[at] ? 0 : 1;
            named[at] = true;
        }
    }
    return {};
}

} // namespace

std::optional<HeaderFault> meaningFault(const Message& message)
{
    QString fault;
    if (const auto* put = std::get_if<PutFrame>(&message))
    {
        fault = cameraFault(put->camera);
    }
    else if (const auto* render = std::get_if<Render>(&message))
    {
        fault = framesFault(render->frames);
    }
    return fault.isEmpty() ? std::nullopt : std::optional<HeaderFault>({ErrorCode::BadValue, fault});
}

} // namespace lampblack::protocol
