// Reads the view transform of Pencil2D, which is private.
//
// ViewManager has five QTransform members in a row: the view, its inverse, the view onto the widget, its
// inverse, and the widget's centre. It has no getter that can be called by name. So its memory is searched
// once for five matrices with these relations. The memory is read through a pipe, which fails for addresses
// that cannot be read, where a direct access would crash. In another build the matrices are found at another
// place, or not at all.
#pragma once

#include "host/parts.h"

#include <QByteArray>

#include <array>
#include <optional>

namespace lampblack
{

/// The five matrices of ViewManager, in its order.
struct ViewMatrices
{
    QTransform view; ///< Pencil2D's canvas to centred widget, before flips
    QTransform viewInverse;
    QTransform widget; ///< Pencil2D's canvas to widget, logical pixels
    QTransform widgetInverse;
    QTransform centre;
};

/// Whether two affine transforms differ by less than a pixel shows.
bool areNear(const QTransform& a, const QTransform& b);

/// Copy `size` bytes from `address`; empty if not all of them can be read. Never crashes.
QByteArray readSafely(const void* address, int size);

/// The five matrices at `offset` of `bytes`, in the memory layout of Qt 5's QTransform.
std::optional<ViewMatrices> matricesAt(const QByteArray& bytes, int offset);

/// Whether the five matrices can belong together in a widget of this size.
bool areConsistent(const ViewMatrices& matrices, const QSize& widget);

/// The offset in `bytes` of five consistent matrices with these flips and this zoom (0: unknown). -1 if there
/// are none, or more than one place.
int findMatrices(const QByteArray& bytes, const QSize& widget, bool flipX, bool flipY, double zoom);

/// The zoom that the status bar shows, as a factor; 0 if there is none.
double zoomOf(const QString& label);

/// The view as Pencil2D paints it: without rotation and at a whole zoom, it paints bitmaps at the nearest
/// whole pixel (halves are rounded up). Logical pixels, of which its canvas has `ratio` across and down each.
QTransform snappedToPixels(const QTransform& widget, double ratio = 1);

class ViewReader
{
public:
    explicit ViewReader(const Parts& parts) : mParts(parts) {}

    /// The current matrices; no value while they are not found.
    std::optional<ViewMatrices> read();

private:
    bool findOffset();

    Parts mParts;
    int mOffset = -1;
};

} // namespace lampblack
