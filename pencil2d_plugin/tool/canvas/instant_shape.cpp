#include "tool/canvas/instant_shape.h"

#include "tool/canvas/figure_mask.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lampblack
{

namespace
{

constexpr int LongSide = 160; ///< elements
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
