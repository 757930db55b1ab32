#include "tool/canvas/light_ratio.h"

#include <QVector>

#include <algorithm>
#include <array>

namespace lampblack
{

namespace
{

constexpr int Near = 1;     ///< pixels around one over which light is averaged
constexpr int Block = 16;   ///< pixels of the surroundings
constexpr float Trust = 24; ///< a sum of drawn values this small counts as much as the surroundings
constexpr float Brightest = 16;

/// The ratio in blocks of the picture, one channel.
class Surroundings
{
public:
    Surroundings(const QImage& lit, const QImage& drawn, int channel)
        : mWidth((lit.width() + Block - 1) / Block), mHeight((lit.height() + Block - 1) / Block),
          mRatio(mWidth * mHeight, 1)
    {
        QVector<float> sums(mRatio.size(), 0);
        QVector<float> drawnSums(mRatio.size(), 0);
        for (int y = 0; y < lit.height(); ++y)
        {
            const uchar* a = lit.constScanLine(y) + channel;
            const uchar* b = drawn.constScanLine(y) + channel;
            float* sum = sums.data() + y / Block * mWidth;
            float* drawnSum = drawnSums.data() + y / Block * mWidth;
            for (int x = 0; x < lit.width(); ++x)
            {
                sum[x / Block] += a[4 * x];
                drawnSum[x / Block] += b[4 * x];
            }
        }
        for (int i = 0; i < mRatio.size(); ++i)
            mRatio[i] = std::min(Brightest, (sums[i] + Trust) / (drawnSums[i] + Trust));
    }
    float at(int x, int y) const { return mRatio.constData()[y / Block * mWidth + x / Block]; }

private:
    int mWidth;
    int mHeight;
    QVector<float> mRatio;
};

/// Sums over the pixels around each of a row, one channel.
void sumAround(const QImage& image, int y, int channel, QVector<int>& sums, QVector<int>& columns)
{
    columns.fill(0);
    const int top = std::max(0, y - Near);
    const int bottom = std::min(image.height() - 1, y + Near);
    for (int j = top; j <= bottom; ++j)
    {
        const uchar* row = image.constScanLine(j) + channel;
        for (int x = 0; x < image.width(); ++x)
            columns.data()[x] += row[4 * x];
    }
    const int last = image.width() - 1;
    for (int x = 0; x <= last; ++x)
    {
        int sum = 0;
        for (int i = std::max(0, x - Near); i <= std::min(last, x + Near); ++i)
            sum += columns.constData()[i];
        sums.data()[x] = sum;
    }
}

} // namespace

LightRatio ratioOf(const QImage& lit, const QImage& drawn)
{
    LightRatio ratio;
    if (lit.size() != drawn.size() || lit.isNull())
        return ratio;
    ratio.darker = QImage(lit.size(), QImage::Format_RGB32);
    ratio.brighter = QImage(lit.size(), QImage::Format_RGB32);
    ratio.darker.fill(Qt::white);
    ratio.brighter.fill(Qt::black);
    bool anyBrighter = false;
    QVector<int> litSums(lit.width());
    QVector<int> drawnSums(lit.width());
    QVector<int> columns(lit.width());
    for (int channel = 0; channel < 3; ++channel)
    {
        const Surroundings around(lit, drawn, channel);
        for (int y = 0; y < lit.height(); ++y)
        {
            sumAround(lit, y, channel, litSums, columns);
            sumAround(drawn, y, channel, drawnSums, columns);
            uchar* darker = ratio.darker.scanLine(y) + channel;
            uchar* brighter = ratio.brighter.scanLine(y) + channel;
            for (int x = 0; x < lit.width(); ++x)
            {
                const int a = litSums.constData()[x];
                const int b = drawnSums.constData()[x];
                if (a == b && float(b) > Trust)
                    continue;
                const float r =
                    std::min(Brightest, (float(a) + Trust * around.at(x, y)) / (float(b) + Trust));
                if (r <= 1)
                {
                    darker[4 * x] = uchar(255 * r + 0.5F);
                    continue;
                }
                brighter[4 * x] = uchar(255 * (1 - 1 / r) + 0.5F);
                anyBrighter = true;
            }
        }
    }
    if (!anyBrighter)
        ratio.brighter = QImage();
    return ratio;
}

void LightRatio::paint(QPainter& painter, const QPointF& at) const
{
    const auto before = painter.compositionMode();
    painter.setCompositionMode(QPainter::CompositionMode_Multiply);
    painter.drawImage(at, darker);
    if (!brighter.isNull())
    {
        painter.setCompositionMode(QPainter::CompositionMode_ColorDodge);
        painter.drawImage(at, brighter);
    }
    painter.setCompositionMode(before);
}

} // namespace lampblack
