#include "plugin/studio.h"

#include "scene/timeline.h"

#include <algorithm>

namespace lampblack
{

namespace
{
constexpr int ProgressMs = 60000; ///< longer than a frame of a job takes
}

Studio::Studio(Host& host, std::unique_ptr<Worker> worker, QObject* parent)
    : QObject(parent), mHost(host), mWorker(std::move(worker)),
      mTool(std::make_unique<LampTool>(host, *mWorker, mDocument)),
      mFeed(std::make_unique<FrameFeed>(host, *mWorker, mDocument)),
      mUnlit(std::make_unique<UnlitLayers>(host, *mFeed, mDocument)),
      mView(std::make_unique<LitView>(host, *mWorker, *mFeed, *mUnlit, mDocument, *mTool)),
      mCuts(std::make_unique<CutFeed>(host, *mWorker, *mFeed, mDocument, *mTool)),
      mLayer(std::make_unique<LitLayer>(host, mDocument)),
      mJob(std::make_unique<ShotJob>(host, *mWorker, *mFeed, *mLayer, mDocument)),
      mLitFrames(std::make_unique<LitFrames>(host, *mFeed, *mLayer, mDocument,
                                             [this](int frame) { return mJob->framePath(frame); })),
      mProject(std::make_unique<ProjectScene>(host, mDocument, *mLayer)), mMaterialsRoom(host)
{
    setObjectName(QStringLiteral("lampblack"));
    connect(mTool.get(), &LampTool::activeChanged, this, &Studio::onToolActive);
    connect(mTool.get(), &LampTool::lightingChanged, this,
            [this]
            {
                if (!mTool->isActive())
                    updateFeed();
            });
    connect(&mDocument, &SceneDocument::sceneChanged, this, &Studio::sendScene);
    connect(mWorker.get(), &Worker::imageArrived, this,
            [this](const PreviewImage& image)
            {
                if (image.frame == mHost.currentFrame())
                    mShownImage = image;
            });
    connect(mWorker.get(), &Worker::paletteArrived, this, &Studio::onPaletteArrived);
    connect(mFeed.get(), &FrameFeed::frameSent, mWorker.get(),
            [this](int frame)
            {
                if (frame == mHost.currentFrame() && mTool->isActive())
                    mWorker->requestPalette(frame);
            });
    connect(&host, &Host::projectOpened, this,
            [this](const QString& path)
            {
                mColourPixels.clear();
                mProjectPath = path;
            });
    connectJobs();
}

Studio::~Studio()
{
    close();
}

bool Studio::isSettled() const
{
    const std::optional<Show> mode = mTool ? mTool->viewMode() : std::nullopt;
    return mShownImage.converged && (!mode || mShownImage.show == *mode) &&
           mShownImage.frame == mHost.currentFrame() && mFeed && mFeed->isUpToDate(mShownImage.frame) &&
           mView->isLit() && mWorker->isCurrent(mShownImage);
}

QVariantList Studio::lightPlaces() const
{
    QVariantList places;
    for (const AreaLight& light : sceneAt(mDocument.scene(), mHost.currentFrame()).lights)
        places.append(QVariant(QVariantList{light.x, light.y}));
    return places;
}

QVariantList Studio::cutPlaces() const
{
    QVariantList places;
    const QVector<Cut> cuts = mTool ? mTool->cuts() : QVector<Cut>();
    for (const Cut& cut : cuts)
    {
        QVariantList points;
        for (const QPointF& point : cut.line)
            points.append(QVariant(QVariantList{point.x(), point.y()}));
        places.append(QVariant(points));
    }
    return places;
}

void Studio::close()
{
    mLitFrames.reset();
    mJob.reset();
    mCuts.reset();
    mView.reset();
    mUnlit.reset();
    mFeed.reset();
    mProject.reset();
    mLayer.reset();
    mTool.reset();
    mWorker->stop();
}

void Studio::onToolActive(bool active)
{
    updateFeed();
    if (!active)
        return;
    // Not earlier, so that an artist who never lights does not pay for a worker.
    mWorker->start();
    sendScene();
}

void Studio::updateFeed()
{
    mFeed->setPatient(mTool->isDrawing());
    mFeed->setEnabled(mTool->isLighting() || mJob->runningKind() != ShotJob::Kind::None);
}

void Studio::sendScene()
{
    mWorker->setScene(mDocument.scene());
    mSentRevision = mWorker->revision();
    mView->onSceneSent();
}

void Studio::onPaletteArrived(int frame, const QVector<Swatch>& swatches)
{
    if (frame != mHost.currentFrame())
        return;
    for (const Swatch& swatch : swatches)
        mColourPixels[swatch.colour] = std::max(mColourPixels.value(swatch.colour), swatch.pixels);
    QVector<Swatch> all;
    for (auto colour = mColourPixels.cbegin(); colour != mColourPixels.cend(); ++colour)
        all.append({colour.key(), colour.value()});
    std::sort(all.begin(), all.end(), [](const Swatch& a, const Swatch& b) { return a.pixels > b.pixels; });
    mTool->setPalette(all);
}

FrameRange Studio::selectedRange() const
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
    return {mHost.firstFrame(), mHost.frameCount()};
}

void Studio::connectJobs()
{
    // A job may be started before the lamp tool was ever picked.
    const auto startWorker = [this]
    {
        mWorker->start();
        mFeed->setEnabled(true);
        sendScene();
    };
    connect(mTool.get(), &LampTool::generateSurfacesRequested, mJob.get(),
            [this, startWorker]
            {
                startWorker();
                mJob->generateSurfaces();
            });
    connect(mTool.get(), &LampTool::renderAllRequested, mJob.get(),
            [this, startWorker]
            {
                startWorker();
                mJob->render(selectedRange(), {mTool->hidesSources(), mTool->apart()});
            });
    connect(mTool.get(), &LampTool::renderChangedRequested, mJob.get(),
            [this, startWorker]
            {
                startWorker();
                // The layers that are there stay one, or apart.
                ApartKind apart = mTool->apart();
                if (mLayer->isApart() || apart == ApartKind::Pencil2d || apart == ApartKind::Exr)
                    apart = mLayer->isApart() ? ApartKind::Pencil2d : ApartKind::None;
                mJob->renderFrames(mLitFrames->outdated(), {false, apart});
            });
    connect(mJob.get(), &ShotJob::framesDelivered, mLitFrames.get(), &LitFrames::setLit);
    connect(mLitFrames.get(), &LitFrames::changed, this,
            [this] { mTool->setOutdated(mLitFrames->outdated().size(), mLitFrames->total()); });
    connect(mTool.get(), &LampTool::cancelRequested, mJob.get(), &ShotJob::cancel);
    connect(mJob.get(), &ShotJob::problem, mTool.get(), &LampTool::showProblem);
    connect(mJob.get(), &ShotJob::progressChanged, this,
            [this](ShotJob::Kind, int done, int total, const QString& doing)
            {
                mTool->setProgress(doing, done, total);
                mHost.showStatus(tr("%1: %2 of %3").arg(doing).arg(done).arg(total), ProgressMs);
            });
    connect(mJob.get(), &ShotJob::finished, this,
            [this](ShotJob::Kind, const QString& message)
            {
                mTool->setProgress(QString(), 0, 0);
                mHost.showStatus(message, 10000);
                updateFeed();
            });
}

} // namespace lampblack
