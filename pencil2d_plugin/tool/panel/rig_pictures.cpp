#include "tool/panel/rig_pictures.h"

namespace lampblack
{

namespace
{
constexpr int MaxFrames = 64;
}

RigPictures::RigPictures(Host& host, Worker& worker, RigMenu& menu)
    : QObject(&menu), mHost(host), mWorker(worker), mMenu(menu), mKept(MaxFrames)
{
    connect(&menu, &QMenu::aboutToShow, this, &RigPictures::onOpened);
    connect(&worker, &Worker::rigsArrived, this,
            [this](int frame, const QVector<RigSketch>& sketches)
            {
                mKept.insert(frame, new QVector<RigSketch>(sketches));
                if (frame == mHost.currentFrame())
                    mMenu.setPictures(sketches);
            });
    // A drawing may be held over several frames.
    const auto forget = [this]
    {
        mKept.clear();
    };
    connect(&host, &Host::drawingChanged, this, forget);
    connect(&host, &Host::layersChanged, this, forget);
    connect(&host, &Host::projectOpened, this, forget);
}

void RigPictures::onOpened()
{
    const int frame = mHost.currentFrame();
    const QVector<RigSketch>* kept = mKept.object(frame);
    mMenu.setPictures(kept != nullptr ? *kept : QVector<RigSketch>());
    mWorker.requestRigs(frame, mMenu.pictureSide());
}

} // namespace lampblack
