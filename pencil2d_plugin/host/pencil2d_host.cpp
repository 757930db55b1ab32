#include "host/pencil2d_host.h"

#include <QMenu>
#include <QSettings>
#include <QStatusBar>

#include <algorithm>

namespace lampblack
{

namespace
{

constexpr int SurveyDelayMs = 50;
constexpr int MaxLayerAttempts = 20; ///< the list needs some time for its layout
const QSize DefaultCanvas(800, 600);

/// Beside Pencil2D's own, which are left alone.
QSettings ourSettings()
{
    return QSettings(QStringLiteral("Lampblack"), QStringLiteral("Pencil2D"));
}

bool isStatic(const CameraPath& path)
{
    return std::all_of(path.begin(), path.end(), [](const QTransform& view) { return view.isIdentity(); });
}

bool isSame(const Layer& a, const Layer& b)
{
    return a.name == b.name && a.kind == b.kind && a.visible == b.visible;
}

} // namespace

Pencil2DHost::Pencil2DHost(const Parts& parts, QObject* parent)
    : Host(parent), mParts(parts), mIdleness(nullptr), mTransport(parts, nullptr), mProject(parts, nullptr),
      mLeaveGuard(parts, nullptr), mTitleMark(parts, nullptr), mPlaces(parts), mRows(parts), mGuides(parts),
      mView(parts), mQueue(parts, &mIdleness, nullptr), mDelivery(parts, &mIdleness, nullptr),
      mDrawing(parts, &mIdleness, nullptr), mPalette(parts, nullptr),
      mCameraSurvey(parts, &mIdleness, &mTransport, &mPalette, &mView), mOptions(parts, nullptr),
      mCanvasSize(DefaultCanvas)
{
    connect(&mPalette, &ToolPalette::activated, this,
            [this](bool active)
            {
                mDrawing.setToolActive(active);
                mOptions.show(active);
                Q_EMIT toolActivated(active);
            });
    connect(&mTransport, &Transport::frameChanged, this,
            [this](int frame)
            {
                mQueue.setCurrentFrame(frame);
                Q_EMIT frameChanged(frame);
            });
    connect(&mTransport, &Transport::frameCountChanged, this, &Host::frameCountChanged);
    connect(&mTransport, &Transport::playingChanged, this,
            [this](bool playing)
            {
                mQueue.setPlaying(playing);
                mDelivery.setPlaying(playing);
                Q_EMIT playingChanged(playing);
            });
    connect(&mProject, &ProjectWatch::opened, this, &Pencil2DHost::onProjectOpened);
    connect(&mProject, &ProjectWatch::saved, this, &Host::projectSaved);
    connect(&mDrawing, &DrawingWatch::changed, this,
            [this]
            {
                forgetCamera();
                Q_EMIT drawingChanged(currentFrame());
            });
    connect(&mDrawing, &DrawingWatch::manyChanged, this,
            [this]
            {
                forgetCamera();
                Q_EMIT drawingsChanged();
            });
    connect(&mDrawing, &DrawingWatch::layersMaybeChanged, this, &Pencil2DHost::onLayersMaybeChanged);
    connect(&mDrawing, &DrawingWatch::eyeMaybeChanged, this, &Pencil2DHost::surveyEyes);
    connect(&mQueue, &FrameQueue::dialogRead, this, &Pencil2DHost::onDialogRead);
    connect(&mQueue, &FrameQueue::exported, this, &Pencil2DHost::onExported);
    connect(&mQueue, &FrameQueue::failed, this, &Host::exportFailed);
    connect(&mDelivery, &LayerDelivery::delivered, this,
            [this](const QString& name)
            {
                surveyLayers();
                Q_EMIT layerDelivered(name);
            });
    connect(&mDelivery, &LayerDelivery::failed, this, &Host::layerFailed);
    connect(&mCameraSurvey, &CameraSurvey::read, this, &Pencil2DHost::onCameraRead);
    if (has(parts.view, "viewChanged()"))
        connect(parts.view, SIGNAL(viewChanged()), this, SIGNAL(viewChanged()));
    if (has(parts.layers, "currentLayerChanged(int)"))
        connect(parts.layers, SIGNAL(currentLayerChanged(int)), this, SLOT(onCurrentLayerChanged(int)));
    if (has(parts.colours, "colorChanged(QColor,int)"))
        connect(parts.colours, SIGNAL(colorChanged(QColor, int)), this, SIGNAL(colourChosen(QColor)));
    connect(parts.window->statusBar(), &QStatusBar::messageChanged, this, &Pencil2DHost::restoreStatus);
    if (has(parts.preferences, "optionChanged(SETTING)"))
        connect(parts.preferences, SIGNAL(optionChanged(SETTING)), this, SLOT(forgetPaper()));

    mQueue.setCurrentFrame(mTransport.currentFrame());
    mSurveyTimer.setSingleShot(true);
    mSurveyTimer.setInterval(SurveyDelayMs);
    connect(&mSurveyTimer, &QTimer::timeout, this, &Pencil2DHost::surveyProject);
    mSurveyTimer.start();
}

Pencil2DHost::~Pencil2DHost() = default;

bool Pencil2DHost::can(Ability ability) const
{
    return whyNot(ability).isEmpty();
}

QString Pencil2DHost::whyNot(Ability ability) const
{
    QString reason = lampblack::whyNot(mParts, ability);
    if (!reason.isEmpty())
        return reason;
    if (ability == Ability::View && !mView.read())
        return QStringLiteral("This version of Pencil2D does not show where its canvas lies.");
    if (ability == Ability::Layers && !mLayersAnswer)
        return QStringLiteral("The list of layers of this version of Pencil2D does not answer.");
    return {};
}

void Pencil2DHost::addTool(QAction* tool)
{
    if (mParts.window != nullptr)
        mPalette.add(tool);
}

void Pencil2DHost::setToolPanel(QWidget* panel)
{
    if (can(Ability::Panel))
        mOptions.setPanel(panel);
}

void Pencil2DHost::showStatus(const QString& text, int milliseconds)
{
    if (mParts.window == nullptr)
        return;
    if (milliseconds == 0)
        mStatus = text;
    mParts.window->statusBar()->showMessage(text, milliseconds);
}

void Pencil2DHost::restoreStatus(const QString& shown)
{
    // Queued, because the message is still being cleared. Pencil2D 0.7 would show the hint of its own tool.
    if (shown.isEmpty() && !mStatus.isEmpty())
        QTimer::singleShot(0, this, [this] { showStatus(mStatus, 0); });
}

QVariant Pencil2DHost::remembered(const QString& key, const QVariant& otherwise) const
{
    return ourSettings().value(key, otherwise);
}

void Pencil2DHost::remember(const QString& key, const QVariant& value)
{
    ourSettings().setValue(key, value);
}

std::optional<QTransform> Pencil2DHost::canvasToWidget() const
{
    const auto matrices = mView.read();
    if (!matrices)
        return std::nullopt;
    const QPointF origin = originIn(mCanvasSize);
    const QTransform toOrigin = QTransform::fromTranslate(-origin.x(), -origin.y());
    // Pencil2D 0.6 scales what it painted, where a screen has more pixels than logical ones.
    const double ratio = mParts.isSince07 ? mParts.canvas->devicePixelRatioF() : 1;
    return toOrigin * snappedToPixels(matrices->widget, ratio);
}

void Pencil2DHost::goToFrame(int frame)
{
    const Idleness::Work work(&mIdleness);
    mTransport.goTo(frame);
}

QColor Pencil2DHost::paper() const
{
    if (mPaper.isValid() || mParts.background == nullptr)
        return mPaper.isValid() ? mPaper : QColor(Qt::white);
    constexpr int Side = 32;
    QImage patch(Side, Side, QImage::Format_RGB32);
    patch.fill(Qt::white);
    // The centre, because there is a shadow along the edges.
    const QPoint corner = mParts.background->rect().center() - QPoint(Side / 2, Side / 2);
    mParts.background->render(&patch, QPoint(), QRegion(QRect(corner, patch.size())),
                              QWidget::DrawWindowBackground);
    mPaper = QColor(patch.scaled(1, 1, Qt::IgnoreAspectRatio, Qt::SmoothTransformation).pixel(0, 0));
    return mPaper;
}

void Pencil2DHost::requestFrames(int first, int last, const QStringList& layers)
{
    if (can(Ability::Frames))
    {
        mQueue.request(first, last, layers);
        return;
    }
    const UserError error{
        QStringLiteral("Frames cannot be read from this version of Pencil2D."),
        QStringLiteral("Use Pencil2D 0.6.6 to 0.7.2, or light the exported images on the command line."),
        whyNot(Ability::Frames)};
    for (int frame = first; frame <= last; ++frame)
        Q_EMIT exportFailed(frame, error);
}

void Pencil2DHost::hideLayers(const QStringList& names)
{
    if (!can(Ability::Layers))
        return;
    {
        const Idleness::Work work(&mIdleness);
        const QVector<bool> open = mRows.eyes(mLayers.size());
        for (int row = 0; row < mLayers.size(); ++row)
        {
            if (open[row] && names.contains(mLayers[row].name))
                mRows.clickEye(row);
        }
    }
    surveyEyes();
}

void Pencil2DHost::deliverLayer(const QString& name, const QMap<int, QString>& pictures)
{
    if (can(Ability::Deliver))
    {
        mDelivery.deliver(name, pictures, mCamera, frameCount());
        return;
    }
    Q_EMIT layerFailed({QStringLiteral("This version of Pencil2D takes no layer from Lampblack."),
                        QStringLiteral("Import the rendered frames as an image sequence."),
                        whyNot(Ability::Deliver)});
}

/// If it may have been moved: its layer is the current one.
void Pencil2DHost::forgetCamera()
{
    if (!mOnCamera)
        return;
    mCameraKnown = false;
    mSurveyTimer.start();
}

void Pencil2DHost::onCurrentLayerChanged(int index)
{
    if (mIdleness.isWorking())
        return;
    mCurrentRow = mLayers.size() - 1 - index;
    const bool camera = isCamera(mCurrentRow);
    if (mOnCamera && !camera)
    {
        mCameraKnown = false;
        mSurveyTimer.start();
    }
    mOnCamera = camera;
    // While a camera is the current layer, Pencil2D shows its view, without a signal.
    Q_EMIT viewChanged();
}

void Pencil2DHost::onProjectOpened(const QString& path)
{
    mQueue.cancel();
    mDelivery.cancel();
    leaveCamera();
    mLayers.clear();
    mLayersKnown = false;
    mCameraKnown = false;
    mSurveyTimer.start();
    Q_EMIT projectOpened(path);
    Q_EMIT viewChanged();
}

void Pencil2DHost::onLayersMaybeChanged()
{
    mLayersKnown = false;
    mCameraKnown = mCameraKnown && !mCameraSurvey.isReading(); // it may be in another row now
    mSurveyTimer.start();
}

void Pencil2DHost::onDialogRead(const ExportResult& exported)
{
    if (exported.cameras.isEmpty())
        return;
    if (mCameraName.isEmpty() || !exported.cameras.contains(mCameraName))
        mCameraName = exported.cameras.first();
    mQueue.setCamera(mCameraName);
    mTransport.setFrameCount(exported.frameCount);
    const QSize size = exported.sizes.value(exported.cameras.indexOf(mCameraName));
    if (!size.isEmpty() && size != mCanvasSize)
    {
        mCanvasSize = size;
        Q_EMIT viewChanged();
    }
}

void Pencil2DHost::onExported(int frame, const QStringList& layers, const QImage& image)
{
    Q_EMIT frameExported({frame, image, canvasToImage(cameraAt(mCamera, frame), image.size()), layers});
}

void Pencil2DHost::surveyProject()
{
    if (mParts.window == nullptr)
        return;
    auto* selection = mParts.window->findChild<QMenu*>(QStringLiteral("menuSelection"));
    const bool isSelecting = selection != nullptr && selection->isEnabled();
    if (!mIdleness.isIdle() || isPlaying() || isSelecting)
    {
        mSurveyTimer.start();
        return;
    }
    {
        const Idleness::Work work(&mIdleness);
        if (lampblack::whyNot(mParts, Ability::Frames).isEmpty())
            onDialogRead(ExportDialog(mParts).inspect());
    }
    if (!mLayersKnown && lampblack::whyNot(mParts, Ability::Layers).isEmpty() && !surveyLayers())
    {
        mSurveyTimer.start();
        return;
    }
    if (!mCameraKnown)
    {
        mCameraKnown = true;
        surveyCamera();
    }
}

bool Pencil2DHost::surveyLayers()
{
    const Idleness::Work work(&mIdleness);
    const QVector<Layer> layers = mRows.read();
    mLayersAnswer = !layers.isEmpty();
    mLayersKnown = mLayersAnswer || ++mLayerAttempts >= MaxLayerAttempts;
    if (!mLayersKnown)
        return false;
    mLayerAttempts = 0;
    mCurrentRow = mRows.currentRow();
    const bool isKnown = std::equal(layers.begin(), layers.end(), mLayers.begin(), mLayers.end(), isSame);
    mLayers = layers;
    mOnCamera = isCamera(mCurrentRow);
    if (isKnown)
        return true;
    mQueue.setLayers(layers);
    Q_EMIT layersChanged();
    return true;
}

bool Pencil2DHost::isCamera(int row) const
{
    return row >= 0 && row < mLayers.size() && mLayers[row].kind == Layer::Kind::Camera;
}

void Pencil2DHost::surveyEyes()
{
    const QVector<bool> eyes = mRows.eyes(mLayers.size());
    bool changed = false;
    for (int row = 0; row < eyes.size(); ++row)
    {
        changed = changed || mLayers[row].visible != eyes[row];
        mLayers[row].visible = eyes[row];
    }
    if (!changed)
        return;
    mQueue.setLayers(mLayers);
    Q_EMIT layersChanged();
    Q_EMIT drawingChanged(currentFrame());
}

/// Frames wait for it.
void Pencil2DHost::surveyCamera()
{
    leaveCamera();
    for (int row = mLayers.size() - 1; row >= 0; --row)
    {
        if (!isCamera(row) || mLayers[row].name != mCameraName)
            continue;
        mQueue.setWaiting(true);
        mCameraSurvey.begin(row, mCanvasSize);
        return;
    }
}

void Pencil2DHost::leaveCamera()
{
    mCameraSurvey.cancel();
    mQueue.setWaiting(false);
}

void Pencil2DHost::onCameraRead(const CameraPath& path)
{
    const bool moved = !isStatic(mCamera) || !isStatic(path);
    const bool changed = moved && mCamera != path;
    mCamera = path;
    mQueue.setWaiting(false);
    // Frames exported before show the camera as it was.
    if (changed)
        Q_EMIT layersChanged();
}

Host* createHost(QObject* parent)
{
    QMainWindow* window = findMainWindow();
    if (window == nullptr)
        return nullptr;
    const Parts parts = findParts(window);
    if (parts.canvas == nullptr || parts.editor == nullptr)
    {
        qInfo("Lampblack: this is not a Pencil2D that it knows.");
        return nullptr;
    }
    return new Pencil2DHost(parts, parent);
}

} // namespace lampblack
