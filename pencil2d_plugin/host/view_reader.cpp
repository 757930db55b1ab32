#include "host/view_reader.h"

#include <QLabel>
#include <QRegularExpression>
#include <QStatusBar>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace lampblack
{

namespace
{

constexpr std::ptrdiff_t MatrixBytes = sizeof(QTransform);
constexpr std::ptrdiff_t MatrixCount = 5;
constexpr int SearchBytes = 1024;
constexpr double Tolerance = 1e-6;

QTransform matrixAt(const char* bytes)
{
    std::array<double, 9> m{};
    std::memcpy(m.data(), bytes, sizeof(m));
    // Qt 5 keeps the six affine numbers first, then the third column.
    return QTransform(m[0], m[1], m[6], m[2], m[3], m[7], m[4], m[5], m[8]);
}

bool isAffine(const QTransform& m)
{
    for (const double value : {m.m11(), m.m12(), m.m21(), m.m22(), m.dx(), m.dy()})
    {
        if (!std::isfinite(value) || std::abs(value) > 1e9)
            return false;
    }
    return m.m13() == 0 && m.m23() == 0 && m.m33() == 1 && std::abs(m.determinant()) > 1e-9;
}

} // namespace

bool areNear(const QTransform& a, const QTransform& b)
{
    const double reach = 1 + std::abs(b.dx()) + std::abs(b.dy());
    return std::abs(a.m11() - b.m11()) < Tolerance && std::abs(a.m12() - b.m12()) < Tolerance &&
           std::abs(a.m21() - b.m21()) < Tolerance && std::abs(a.m22() - b.m22()) < Tolerance &&
           std::abs(a.dx() - b.dx()) < Tolerance * reach && std::abs(a.dy() - b.dy()) < Tolerance * reach;
}

QByteArray readSafely(const void* address, int size)
{
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC | O_NONBLOCK) != 0)
        return {};
    QByteArray bytes(size, '\0');
    // Not write(): the address sanitizer would report that we read outside of objects, which we intend.
    const bool isWhole = ::syscall(SYS_write, ends[1], address, static_cast<size_t>(size)) == size &&
                         ::read(ends[0], bytes.data(), static_cast<size_t>(size)) == size;
    ::close(ends[0]);
    ::close(ends[1]);
    return isWhole ? bytes : QByteArray();
}

std::optional<ViewMatrices> matricesAt(const QByteArray& bytes, int offset)
{
    if (offset < 0 || offset + MatrixCount * MatrixBytes > bytes.size())
        return std::nullopt;
    const char* at = bytes.constData() + offset;
    ViewMatrices matrices{matrixAt(at), matrixAt(at + MatrixBytes), matrixAt(at + 2 * MatrixBytes),
                          matrixAt(at + 3 * MatrixBytes), matrixAt(at + 4 * MatrixBytes)};
    for (const QTransform& m :
         {matrices.view, matrices.viewInverse, matrices.widget, matrices.widgetInverse, matrices.centre})
    {
        if (!isAffine(m))
            return std::nullopt;
    }
    return matrices;
}

bool areConsistent(const ViewMatrices& matrices, const QSize& widget)
{
    const QTransform centre = QTransform::fromTranslate(widget.width() / 2.0, widget.height() / 2.0);
    return areNear(matrices.view * matrices.viewInverse, QTransform()) &&
           areNear(matrices.widget * matrices.widgetInverse, QTransform()) &&
           areNear(matrices.centre, centre);
}

int findMatrices(const QByteArray& bytes, const QSize& widget, bool flipX, bool flipY, double zoom)
{
    const QTransform flip = QTransform::fromScale(flipX ? -1 : 1, flipY ? -1 : 1);
    int found = -1;
    for (int offset = 0; offset + MatrixCount * MatrixBytes <= bytes.size(); offset += int(sizeof(void*)))
    {
        const auto matrices = matricesAt(bytes, offset);
        if (!matrices || !areConsistent(*matrices, widget) ||
            !areNear(matrices->view * flip * matrices->centre, matrices->widget))
        {
            continue;
        }
        const double scale = std::sqrt(std::abs(matrices->view.determinant()));
        if (zoom > 0 && std::abs(scale - zoom) > 0.001 + 0.001 * zoom)
            continue;
        if (found >= 0)
            return -1;
        found = offset;
    }
    return found;
}

double zoomOf(const QString& label)
{
    static const QRegularExpression percent(QStringLiteral("(\\d+(?:[.,]\\d+)?)\\s*%"));
    const QRegularExpressionMatch match = percent.match(label);
    return match.hasMatch() ? match.captured(1).replace(QLatin1Char(','), QLatin1Char('.')).toDouble() / 100
                            : 0;
}

QTransform snappedToPixels(const QTransform& widget, double ratio)
{
    const auto isWhole = [](double value)
    {
        return std::abs(value - std::round(value)) < Tolerance;
    };
    if (std::abs(widget.m12()) > Tolerance || std::abs(widget.m21()) > Tolerance || !isWhole(widget.m11()) ||
        !isWhole(widget.m22()) || std::abs(widget.m11()) < 0.5)
    {
        return widget;
    }
    return QTransform(widget.m11(), 0, 0, widget.m22(), std::floor(widget.dx() * ratio + 0.5) / ratio,
                      std::floor(widget.dy() * ratio + 0.5) / ratio);
}

bool ViewReader::findOffset()
{
    const QByteArray bytes = readSafely(mParts.view, SearchBytes);
    double zoom = 0;
    const auto labels = mParts.window->statusBar()->findChildren<QLabel*>();
    for (const QLabel* label : labels)
        zoom = qMax(zoom, zoomOf(label->text()));
    const QAction* flipX = mParts.action("actionHorizontal_Flip");
    const QAction* flipY = mParts.action("actionVertical_Flip");
    mOffset = findMatrices(bytes, mParts.canvas->size(), flipX != nullptr && flipX->isChecked(),
                           flipY != nullptr && flipY->isChecked(), zoom);
    return mOffset >= 0;
}

std::optional<ViewMatrices> ViewReader::read()
{
    if (mParts.view == nullptr || mParts.canvas == nullptr || mParts.window == nullptr)
        return std::nullopt;
    if (mOffset < 0 && !findOffset())
        return std::nullopt;
    // It can be read: it was found there, and the object still exists.
    const auto* start = reinterpret_cast<const char*>(mParts.view.data()) + mOffset;
    auto matrices = matricesAt(QByteArray::fromRawData(start, int(MatrixCount * MatrixBytes)), 0);
    if (!matrices || !areConsistent(*matrices, mParts.canvas->size()))
        return std::nullopt;
    return matrices;
}

} // namespace lampblack
