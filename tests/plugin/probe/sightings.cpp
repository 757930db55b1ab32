#include "sightings.h"

#include <QApplication>
#include <QBackingStore>
#include <QEvent>
#include <QImage>

namespace
{
constexpr int EveryMs = 20;
constexpr int Stride = 2; // pixels
} // namespace

Sightings::Sightings(QObject* parent) : QObject(parent)
{
    mTimer.setInterval(EveryMs);
    connect(&mTimer, &QTimer::timeout, this, &Sightings::look);
}

void Sightings::watch(QWidget* widget, const QVector<QColor>& colours)
{
    mWidget = widget;
    mColours.clear();
    for (const QColor& colour : colours)
        mColours.append(colour.rgb());
    mTaken = {};
    mLast = -1;
    mClock.start();
    qApp->removeEventFilter(this);
    if (widget == nullptr)
    {
        mTimer.stop();
        return;
    }
    qApp->installEventFilter(this);
    mTimer.start();
    look();
}

bool Sightings::eventFilter(QObject* watched, QEvent* event)
{
    if (event->type() == QEvent::Paint && !mPainted && mWidget &&
        (watched == mWidget || watched->parent() == mWidget))
    {
        mPainted = true;
        QMetaObject::invokeMethod(
            this, [this] { look(); }, Qt::QueuedConnection);
    }
    return false;
}

void Sightings::look()
{
    mPainted = false;
    if (!mWidget || !mWidget->isVisible() || mWidget->window()->backingStore() == nullptr)
        return;
    auto* device = mWidget->window()->backingStore()->paintDevice();
    if (device == nullptr || device->devType() != QInternal::Image)
        return;
    const auto* shown = static_cast<QImage*>(device);
    const double ratio = shown->devicePixelRatio();
    const QRect place(mWidget->mapTo(mWidget->window(), QPoint()) * ratio, mWidget->size() * ratio);
    const QRect seen = place.intersected(shown->rect());
    int count = 0;
    int all = 0;
    for (int y = seen.top(); y <= seen.bottom(); y += Stride)
    {
        const auto* row = reinterpret_cast<const QRgb*>(shown->constScanLine(y));
        for (int x = seen.left(); x <= seen.right(); x += Stride)
        {
            ++all;
            count += mColours.contains(row[x] | 0xff000000U) ? 1 : 0;
        }
    }
    const double share = all > 0 ? double(count) / all : 0;
    if (qFuzzyCompare(1 + share, 1 + mLast))
        return;
    mLast = share;
    mTaken.append(QJsonArray{double(mClock.nsecsElapsed()) / 1e6, share});
}
