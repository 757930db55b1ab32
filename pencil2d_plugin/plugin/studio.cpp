#include "plugin/studio.h"

#include "scene/timeline.h"

#include <algorithm>

namespace lampblack
{

Studio::Studio(Host& host, std::unique_ptr<Worker> worker, QObject* parent)
    : QObject(parent), mHost(host), mWorker(std::move(worker)),
      mTool(std::make_unique<LampTool>(host, *mWorker, mDocument)),
      mFeed(std::make_unique<FrameFeed>(host, *mWorker, mDocument)),
      mAround(std::make_unique<Surroundings>(host, *mFeed, mDocument)),
      mView(std::make_unique<LitView>(host, *mWorker, *mFeed, *mAround, *mTool)),
      mLayer(std::make_unique<LitLayer>(host, mDocument)),
      mJob(std::make_unique<ShotJob>(host, *mWorker, *mFeed, *mLayer, mDocument)),
      mProject(std::make_unique<ProjectScene>(host, mDocument, *mLayer)), mRoom(host)
{
    setObjectName(QStringLiteral("lampblack"));
    connect(mTool.get(), &LampTool::activeChanged, this, &Studio::follow);
    connect(&mDocument, &SceneDocument::sceneChanged, this, &Studio::send);
    connect(mWorker.get(), &Worker::imageArrived, this,
            [this](const LookImage& image)
            {
                if (image.frame == mHost.currentFrame())
                    mShown = image;
            });
    connect(mWorker.get(), &Worker::paletteArrived, this, &Studio::takePalette);
    connect(mFeed.get(), &FrameFeed::freshened, mWorker.get(),
            [this](int frame)
            {
                if (frame == mHost.currentFrame() && mTool->isActive())
                    mWorker->askPalette(frame);
            });
    connect(&host, &Host::projectOpened, this, [this] { mColours.clear(); });
    connectJobs();
}

Studio::~Studio()
{
    close();
}

bool Studio::isSettled() const
{
    return mShown.converged && mShown.frame == mHost.currentFrame() && mFeed &&
           mFeed->isFresh(mShown.frame) && mWorker->isCurrent(mShown);
}

QVariantList Studio::lightPlaces() const
{
    QVariantList places;
    for (const AreaLight& light : sceneAt(mDocument.scene(), mHost.currentFrame()).lights)
        places.append(QVariant(QVariantList{light.x, light.y}));
    return places;
}

void Studio::close()
{
    mJob.reset();
    mView.reset();
    mAround.reset();
    mFeed.reset();
    mProject.reset();
    mLayer.reset();
    mTool.reset();
    mWorker->stop();
}

void Studio::follow(bool active)
{
    mFeed->setOn(active || mJob->running() != ShotJob::Kind::None);
    if (!active)
        return;
    // Not before: an artist who never lights pays nothing for the lamp.
    mWorker->start();
    send();
}

void Studio::send()
{
    mWorker->setScene(mDocument.scene());
    mSent = mWorker->revision();
}

void Studio::takePalette(int frame, const QVector<Swatch>& swatches)
{
    if (frame != mHost.currentFrame())
        return;
    for (const Swatch& swatch : swatches)
        mColours[swatch.colour] = std::max(mColours.value(swatch.colour), swatch.pixels);
    QVector<Swatch> all;
    for (auto colour = mColours.cbegin(); colour != mColours.cend(); ++colour)
        all.append({colour.key(), colour.value()});
    std::sort(all.begin(), all.end(), [](const Swatch& a, const Swatch& b) { return a.pixels > b.pixels; });
    mTool->setPalette(all);
}

FrameRange Studio::chosenRange() const
{
    switch (mTool->shotRange())
    {
    case ShotRange::Loop:
        return mHost.loopRange();
    case ShotRange::Current:
        return {mHost.currentFrame(), mHost.currentFrame()};
    case ShotRange::All:
        break;
    }
    return {1, mHost.frameCount()};
}

void Studio::connectJobs()
{
    // A job may be asked for before the lamp was ever picked.
    const auto ready = [this]
    {
        mWorker->start();
        mFeed->setOn(true);
        send();
    };
    connect(mTool.get(), &LampTool::generateSurfacesRequested, mJob.get(),
            [this, ready]
            {
                ready();
                mJob->generateSurfaces();
            });
    connect(mTool.get(), &LampTool::renderAllRequested, mJob.get(),
            [this, ready]
            {
                ready();
                mJob->render(chosenRange(), mTool->hidesSources());
            });
    connect(mTool.get(), &LampTool::cancelRequested, mJob.get(), &ShotJob::cancel);
    connect(mJob.get(), &ShotJob::problem, mTool.get(), &LampTool::showProblem);
    connect(mJob.get(), &ShotJob::progressed, this,
            [this](ShotJob::Kind kind, int done, int total, const QString& doing)
            {
                if (kind == ShotJob::Kind::Render)
                    mTool->setRenderProgress(done, total);
                else
                    mTool->setSurfaceProgress(done, total);
                mHost.showStatus(QStringLiteral("%1: %2 / %3").arg(doing).arg(done).arg(total));
            });
    connect(mJob.get(), &ShotJob::ended, this,
            [this](ShotJob::Kind kind, const QString& said)
            {
                if (kind == ShotJob::Kind::Render)
                    mTool->setRenderProgress(0, 0);
                else
                    mTool->setSurfaceProgress(0, 0);
                mHost.showStatus(said, 10000);
                mFeed->setOn(mTool->isActive());
            });
}

} // namespace lampblack
