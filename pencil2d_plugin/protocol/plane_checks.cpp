#include "protocol/plane_checks.h"

#include <algorithm>

namespace lampblack::protocol
{
namespace
{

bool rolesAllowed(const Message& message, const QVector<Plane>& planes)
{
    QVector<Role> roles;
    std::transform(planes.begin(), planes.end(), std::back_inserter(roles),
                   [](const Plane& plane) { return plane.role; });
    if (std::holds_alternative<Image>(message) || std::holds_alternative<Rigs>(message) ||
        std::holds_alternative<Normals>(message))
    {
        return roles == QVector<Role>{Role::Picture};
    }
    const auto* put = std::get_if<PutFrame>(&message);
    const int layers = put != nullptr ? put->layers.size() : 0;
    if (layers > 0)
    {
        // Behind the others there is a plane for each name; without pixels there is none.
        const QVector<Role> last(layers, Role::Layer);
        if (roles.size() <= layers || roles.mid(roles.size() - layers) != last)
        {
            return false;
        }
        roles.resize(roles.size() - layers);
    }
    static const QVector<QVector<Role>> Drawings = {{},
                                                    {Role::Pixels},
                                                    {Role::Pixels, Role::Mask},
                                                    {Role::Pixels, Role::Ink},
                                                    {Role::Pixels, Role::Mask, Role::Ink}};
    return put != nullptr ? Drawings.contains(roles) : roles.isEmpty();
}

bool tooLarge(const Plane& plane, const Limits& limits)
{
    const qint64 width = plane.width;
    const qint64 height = plane.height;
    return qMax(width, height) > limits.side || width * height > limits.pixels;
}

bool tooLargeTogether(const QVector<Plane>& planes, const Limits& limits)
{
    qint64 pixels = 0;
    for (const Plane& plane : planes)
    {
        pixels += static_cast<qint64>(plane.width) * plane.height;
    }
    return pixels > limits.framePixels;
}

bool strideShort(const Plane& plane)
{
    return plane.stride < static_cast<qint64>(plane.width) * bytesPerPixel(plane.format);
}

} // namespace

QVector<Plane> planesOf(const Message& message)
{
    if (const auto* put = std::get_if<PutFrame>(&message))
    {
        return put->planes;
    }
    if (const auto* rigs = std::get_if<Rigs>(&message))
    {
        return rigs->planes;
    }
    if (const auto* normals = std::get_if<Normals>(&message))
    {
        return normals->planes;
    }
    const auto* image = std::get_if<Image>(&message);
    return image != nullptr ? image->planes : QVector<Plane>();
}

std::optional<HeaderFault> planeFault(const Message& message, const QVector<Bytes>& payloads,
                                      const Limits& limits)
{
    const QVector<Plane> planes = planesOf(message);
    const auto any = [&planes](auto wrong)
    {
        return std::any_of(planes.begin(), planes.end(), wrong);
    };
    if (planes.size() != payloads.size())
    {
        return HeaderFault{ErrorCode::BadPlaneCount,
                           QStringLiteral("%1 announced, %2 came").arg(planes.size()).arg(payloads.size())};
    }
    if (!rolesAllowed(message, planes))
    {
        return HeaderFault{ErrorCode::BadPlane, QStringLiteral("roles that the message does not carry")};
    }
    if (any([](const Plane& plane) { return plane.format != formatOf(plane.role); }))
    {
        return HeaderFault{ErrorCode::BadPlane, QStringLiteral("a format that is not its role's")};
    }
    if (any([&limits](const Plane& plane) { return tooLarge(plane, limits); }) ||
        tooLargeTogether(planes, limits))
    {
        return HeaderFault{ErrorCode::ImageTooLarge, QString()};
    }
    if (any(strideShort))
    {
        return HeaderFault{ErrorCode::BadPlane, QStringLiteral("a stride shorter than a row")};
    }
    if (any([&planes](const Plane& plane)
            { return plane.width != planes.first().width || plane.height != planes.first().height; }))
    {
        return HeaderFault{ErrorCode::BadPlane, QStringLiteral("planes of several sizes")};
    }
    QVector<PlaneView> views;
    for (int i = 0; i < planes.size(); ++i)
    {
        const Plane& plane = planes[i];
        if (payloads[i].size != static_cast<qint64>(plane.stride) * plane.height)
        {
            return HeaderFault{ErrorCode::PlaneSizeMismatch, QStringLiteral("%1 bytes for %2 x %3")
                                                                 .arg(payloads[i].size)
                                                                 .arg(plane.stride)
                                                                 .arg(plane.height)};
        }
        views.append({plane, static_cast<const uchar*>(payloads[i].data)});
    }
    const auto* put = std::get_if<PutFrame>(&message);
    if (put != nullptr && !views.isEmpty() && frameDigest(views, put->layers) != put->digest)
    {
        return HeaderFault{ErrorCode::DigestMismatch, QString()};
    }
    return std::nullopt;
}

} // namespace lampblack::protocol
