#include "tool/canvas/instant_shape.h"

#include <QPoint>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace lampblack
{

namespace
{

constexpr int LongSide = 160; ///< elements
constexpr int Opaque = 128;   ///< least alpha of what is drawn
constexpr int Alike = 12;     ///< of 255: largest difference in a channel from the ground's colour
constexpr int Sweeps = 24;    ///< of successive over-relaxation, on each of the grids
constexpr float Relaxation = 1.7F;
constexpr int CoarsestSide = 8;

struct Grid
{
    QSize size;
    QVector<char> inside;
    QVector<float> u;

    int at(int x, int y) const { return y * size.width() + x; }
};

using Pixel = const uchar*; ///< four bytes, the last of them alpha, the others in any order

bool isDrawn(Pixel pixel)
{
    return pixel[3] >= Opaque;
}

bool isAlike(Pixel a, Pixel b)
{
    return std::abs(a[0] - b[0]) <= Alike && std::abs(a[1] - b[1]) <= Alike && std::abs(a[2] - b[2]) <= Alike;
}

Pixel pixelOf(const QImage& image, int x, int y)
{
    return image.constScanLine(y) + 4 * x;
}

/// All corners are painted, and alike.
bool isOnGround(const QImage& image)
{
    const int right = image.width() - 1;
    const int bottom = image.height() - 1;
    const Pixel first = pixelOf(image, 0, 0);
    for (const QPoint& at : {QPoint(0, 0), QPoint(right, 0), QPoint(0, bottom), QPoint(right, bottom)})
    {
        const Pixel pixel = pixelOf(image, at.x(), at.y());
        if (!isDrawn(pixel) || !isAlike(pixel, first))
            return false;
    }
    return true;
}

/// 1 where anything is drawn in an element.
QVector<char> drawnElements(const QImage& image, const QSize& size, double step, bool onGround)
{
    QVector<char> drawn(size.width() * size.height(), 0);
    const Pixel ground = pixelOf(image, 0, 0);
    QVector<int> columns(image.width());
    for (int x = 0; x < image.width(); ++x)
        columns[x] = std::min(int(x / step), size.width() - 1);
    for (int y = 0; y < image.height(); ++y)
    {
        char* row = drawn.data() + std::min(int(y / step), size.height() - 1) * size.width();
        const int* column = columns.constData();
        Pixel pixel = image.constScanLine(y);
        for (int x = 0; x < image.width(); ++x, ++column, pixel += 4)
        {
            if (isDrawn(pixel) && !(onGround && isAlike(pixel, ground)))
                row[*column] = 1;
        }
    }
    return drawn;
}

/// 1 where no way over bare elements leads in from the image's edge.
QVector<char> enclosedBy(const QVector<char>& drawn, const QSize& size)
{
    const int width = size.width();
    const int height = size.height();
    QVector<char> inside(drawn.size(), 1);
    QVector<QPoint> front;
    const auto reach = [&](int x, int y)
    {
        const int at = y * width + x;
        if (x < 0 || y < 0 || x >= width || y >= height || inside[at] == 0 || drawn[at] != 0)
            return;
        inside[at] = 0;
        front.append(QPoint(x, y));
    };
    for (int x = 0; x < width; ++x)
    {
        reach(x, 0);
        reach(x, height - 1);
    }
    for (int y = 0; y < height; ++y)
    {
        reach(0, y);
        reach(width - 1, y);
    }
    while (!front.isEmpty())
    {
        const QPoint at = front.takeLast();
        reach(at.x() - 1, at.y());
        reach(at.x() + 1, at.y());
        reach(at.x(), at.y() - 1);
        reach(at.x(), at.y() + 1);
    }
    return inside;
}

Grid halved(const Grid& fine)
{
    Grid coarse;
    coarse.size = QSize((fine.size.width() + 1) / 2, (fine.size.height() + 1) / 2);
    coarse.inside.resize(coarse.size.width() * coarse.size.height());
    coarse.u.fill(0, coarse.inside.size());
    for (int y = 0; y < coarse.size.height(); ++y)
    {
        for (int x = 0; x < coarse.size.width(); ++x)
        {
            const int right = std::min(2 * x + 1, fine.size.width() - 1);
            const int below = std::min(2 * y + 1, fine.size.height() - 1);
            const int share = fine.inside[fine.at(2 * x, 2 * y)] + fine.inside[fine.at(right, 2 * y)] +
                              fine.inside[fine.at(2 * x, below)] + fine.inside[fine.at(right, below)];
            coarse.inside[coarse.at(x, y)] = share >= 2 ? 1 : 0;
        }
    }
    return coarse;
}

/// u of a neighbour of the element at `from`; past the image's edge the surface is level.
float neighbour(const Grid& grid, int x, int y, int from)
{
    if (x < 0 || y < 0 || x >= grid.size.width() || y >= grid.size.height())
        return grid.u[from];
    return grid.u[grid.at(x, y)];
}

void relax(Grid& grid)
{
    struct Element
    {
        int at;
        std::array<int, 4> neighbours;
    };
    QVector<Element> elements;
    const int width = grid.size.width();
    for (int y = 0; y < grid.size.height(); ++y)
    {
        for (int x = 0; x < width; ++x)
        {
            const int at = grid.at(x, y);
            if (grid.inside[at] != 0)
                elements.append(
                    Element{at,
                            {x > 0 ? at - 1 : at, x + 1 < width ? at + 1 : at, y > 0 ? at - width : at,
                             y + 1 < grid.size.height() ? at + width : at}});
        }
    }
    float* u = grid.u.data();
    for (int sweep = 0; sweep < Sweeps; ++sweep)
    {
        for (const Element& element : qAsConst(elements))
        {
            const auto& [left, right, above, below] = element.neighbours;
            const float around = u[left] + u[right] + u[above] + u[below];
            u[element.at] += Relaxation * (around / 4 + 1 - u[element.at]);
        }
    }
}

/// Solve from coarse to fine; u in squared elements.
void solve(Grid& grid)
{
    if (std::min(grid.size.width(), grid.size.height()) > CoarsestSide)
    {
        Grid coarse = halved(grid);
        solve(coarse);
        for (int y = 0; y < grid.size.height(); ++y)
        {
            for (int x = 0; x < grid.size.width(); ++x)
            {
                const int at = grid.at(x, y);
                grid.u[at] = grid.inside[at] != 0 ? 4 * coarse.u[coarse.at(x / 2, y / 2)] : 0;
            }
        }
    }
    relax(grid);
}

} // namespace

InstantShape inflateFigure(const QImage& drawing)
{
    InstantShape shape;
    if (drawing.isNull())
        return shape;
    const bool isPlain = drawing.format() == QImage::Format_RGBA8888 ||
                         drawing.format() == QImage::Format_ARGB32_Premultiplied;
    const QImage image = isPlain ? drawing : drawing.convertToFormat(QImage::Format_RGBA8888);
    shape.step = std::max(1.0, double(std::max(image.width(), image.height())) / LongSide);
    shape.size = QSize(std::max(1, int(std::ceil(image.width() / shape.step))),
                       std::max(1, int(std::ceil(image.height() / shape.step))));
    shape.onGround = isOnGround(image);

    Grid grid;
    grid.size = shape.size;
    const QVector<char> drawn = drawnElements(image, shape.size, shape.step, shape.onGround);
    grid.inside = enclosedBy(drawn, shape.size);
    // Holes in a figure that is filled are holes; what lines enclose is a figure.
    const bool isFilled = !shape.onGround && 2 * drawn.count(1) > grid.inside.count(1);
    grid.u.fill(0, grid.inside.size());
    shape.figure = grid.inside;
    const bool isBounded = grid.inside.contains(0);
    if (isBounded)
        solve(grid);

    shape.enclosed.fill(0, shape.count());
    shape.nx.fill(0, shape.count());
    shape.ny.fill(0, shape.count());
    shape.nz.fill(1, shape.count());
    shape.height.fill(0, shape.count());
    for (int y = 0; y < grid.size.height(); ++y)
    {
        for (int x = 0; x < grid.size.width(); ++x)
        {
            const int at = grid.at(x, y);
            if (grid.inside[at] == 0)
                continue;
            bool deep = !isFilled;
            for (int j = std::max(0, y - 1); j <= std::min(y + 1, grid.size.height() - 1); ++j)
                for (int i = std::max(0, x - 1); i <= std::min(x + 1, grid.size.width() - 1); ++i)
                    deep = deep && grid.inside[grid.at(i, j)] != 0;
            shape.enclosed[at] = deep ? 1 : 0;
            if (!isBounded)
                continue;
            const float across = (neighbour(grid, x + 1, y, at) - neighbour(grid, x - 1, y, at)) / 4;
            const float down = (neighbour(grid, x, y + 1, at) - neighbour(grid, x, y - 1, at)) / 4;
            const float height = std::sqrt(std::max(0.0F, grid.u[at]));
            // A little less steep along the edge, where a coarse grid would leave dark crumbs.
            const float up = std::sqrt(height * height + 1);
            const float length = std::sqrt(across * across + down * down + up * up);
            shape.nx[at] = -across / length;
            shape.ny[at] = -down / length;
            shape.nz[at] = up / length;
            shape.height[at] = float(height * shape.step);
        }
    }
    return shape;
}

void takeNormals(InstantShape& shape, const QImage& picture)
{
    if (picture.isNull() || shape.size.isEmpty())
        return;
    const QImage normals = picture.convertToFormat(QImage::Format_RGBA8888);
    for (int y = 0; y < shape.size.height(); ++y)
    {
        const int row =
            std::min(int((y + 0.5) * normals.height() / shape.size.height()), normals.height() - 1);
        for (int x = 0; x < shape.size.width(); ++x)
        {
            const int column =
                std::min(int((x + 0.5) * normals.width() / shape.size.width()), normals.width() - 1);
            const Pixel pixel = pixelOf(normals, column, row);
            const int at = y * shape.size.width() + x;
            if (!isDrawn(pixel) || shape.figure[at] == 0)
                continue;
            const auto component = [pixel](int channel)
            {
                return float(pixel[channel]) / 127.5F - 1;
            };
            const float right = component(0);
            const float up = component(1);
            const float front = std::max(component(2), 0.02F);
            const float length = std::sqrt(right * right + up * up + front * front);
            shape.nx[at] = right / length;
            shape.ny[at] = -up / length;
            shape.nz[at] = front / length;
        }
    }
}

} // namespace lampblack
