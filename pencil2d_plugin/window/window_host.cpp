#include "window/window_host.h"

#include <QDir>
#include <QFileInfo>
#include <QRegularExpression>
#include <QSettings>
#include <QStatusBar>
#include <QTimer>

#include <algorithm>
#include <iterator>
#include <utility>

namespace lampblack
{

namespace
{

constexpr int ReadingMs = 3000;
constexpr int WarningMs = 15000;
constexpr int DockWidth = 280; // pixels: three buttons of a card

QSettings settings()
{
    return QSettings(QStringLiteral("Lampblack"), QStringLiteral("Window"));
}

/// The name beside which light and lit frames are kept: a pattern without its place for the number.
QString projectOf(const QString& path)
{
    static const QRegularExpression place(QStringLiteral("[._-]?(%0?\\d*d|#+)|\\.(?=\\.)"));
    const QFileInfo info(path);
    return info.exists() ? path : info.absoluteDir().filePath(info.fileName().remove(place));
}

} // namespace

WindowHost::WindowHost(MainWindow& window, QObject* parent) : Host(parent), mWindow(window)
{
    connect(&window, &MainWindow::openRequested, this, &WindowHost::openProject);
    connect(&window, &MainWindow::saveRequested, this, &WindowHost::saveProject);
    connect(&window, &MainWindow::frameChosen, this, &WindowHost::goToFrame);
    connect(&window.canvas(), &CanvasView::viewChanged, this, &Host::viewChanged);
    connect(window.statusBar(), &QStatusBar::messageChanged, this,
            [this](const QString& shown)
            {
                if (shown.isEmpty() && !mStatus.isEmpty()) // queued, because it is still being cleared
                    QTimer::singleShot(0, this, [this] { showStatus(mStatus, 0); });
            });
    connect(&mWatch, &FileWatch::changed, this,
            [this]
            {
                if (mOpening.isEmpty())
                    mReader.read(mOpen, mFrame);
            });
    connect(&mExports, &FrameExports::exported, this, &Host::frameExported);
    connect(&mExports, &FrameExports::failed, this, &Host::exportFailed);
    connect(&mReader, &LayerReader::shotRead, this, &WindowHost::onShotRead);
    connect(&mReader, &LayerReader::frameRead, this, &WindowHost::onFrameRead);
    connect(&mReader, &LayerReader::failed, this, &WindowHost::onFailed);
    connect(&mReader, &LayerReader::finished, this,
            [this](const QString& warnings)
            {
                mHasFailed = false;
                if (!warnings.isEmpty())
                    showStatus(warnings.section(QLatin1Char('\n'), 0, 0), WarningMs);
            });
}

QString WindowHost::whyNot(Ability ability) const
{
    switch (ability)
    {
    case Ability::Palette:
    case Ability::Panel:
        return tr("This window has no other tools.");
    case Ability::Deliver:
        return tr("This window does not change the files of your drawing program: lit frames are files.");
    default:
        return {};
    }
}

void WindowHost::addTool(QAction* tool)
{
    mTool = tool;
    tool->setEnabled(false); // until something is open
    connect(tool, &QAction::toggled, this, &Host::toolActivated);
}

void WindowHost::addDock(QDockWidget* dock)
{
    const bool isFirst = mWindow.findChildren<QDockWidget*>().isEmpty();
    mWindow.addDockWidget(isFirst ? Qt::RightDockWidgetArea : Qt::LeftDockWidgetArea, dock);
}

void WindowHost::giveDocksRoom()
{
    const auto docks = mWindow.findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly);
    QList<int> widths;
    std::fill_n(std::back_inserter(widths), docks.size(), DockWidth);
    mWindow.resizeDocks(docks, widths, Qt::Horizontal);
}

void WindowHost::showStatus(const QString& text, int milliseconds)
{
    if (milliseconds == 0)
        mStatus = text;
    mWindow.statusBar()->showMessage(text, milliseconds);
}

void WindowHost::addStatusWidget(QWidget* widget)
{
    mWindow.statusBar()->addPermanentWidget(widget);
}

QVariant WindowHost::remembered(const QString& key, const QVariant& otherwise) const
{
    return settings().value(key, otherwise);
}

void WindowHost::remember(const QString& key, const QVariant& value)
{
    settings().setValue(key, value);
}

std::optional<QTransform> WindowHost::canvasToWidget() const
{
    if (mOpen.isEmpty())
        return std::nullopt;
    return mExports.frames().value(mFrame).view * mWindow.canvas().imageToWidget();
}

void WindowHost::goToFrame(int frame)
{
    frame = std::clamp(frame, firstFrame(), frameCount());
    mWindow.setFrame(frame);
    if (frame == mFrame)
        return;
    mFrame = frame;
    show();
    Q_EMIT frameChanged(frame);
    Q_EMIT viewChanged(); // each frame has its own camera
}

void WindowHost::deliverLayer(const QString&, const QMap<int, QString>&)
{
    Q_EMIT layerFailed({whyNot(Ability::Deliver), {}, {}});
}

bool WindowHost::openProject(const QString& path)
{
    if (path.isEmpty() || (mMayLeave && !mMayLeave()))
        return false;
    mOpening = QFileInfo(QDir::cleanPath(path)).absoluteFilePath();
    showStatus(tr("Reading %1…").arg(QFileInfo(mOpening).fileName()), ReadingMs);
    mReader.read(mOpening, 0);
    return true;
}

void WindowHost::retry()
{
    if (!mReader.isReading() && (!mOpening.isEmpty() || mHasFailed))
        mReader.read(mOpening.isEmpty() ? mOpen : mOpening, mOpening.isEmpty() ? mFrame : 0);
}

bool WindowHost::saveProject()
{
    if (!mProject.isEmpty())
        Q_EMIT projectSaved(mProject);
    return !mProject.isEmpty();
}

void WindowHost::begin(const QString& path)
{
    mOpen = path;
    mProject = projectOf(path);
    mHasFailed = false;
    mWindow.paper().setHint({});
    mWindow.canvas().setPicture({});
    mWindow.setWindowTitle(tr("%1[*] – Lampblack").arg(QFileInfo(mProject).fileName()));
    mWatch.watch(path);
}

void WindowHost::onShotRead(const Shot& shot)
{
    const Shot before = mExports.shot();
    const QString opened = std::exchange(mOpening, QString());
    if (opened.isEmpty())
    {
        mExports.setShot(shot);
    }
    else
    {
        mExports.begin(shot);
        begin(opened);
    }
    mWindow.canvas().setCanvasSize(shot.canvas);
    mWindow.setFrames(shot.frames);
    if (!opened.isEmpty())
    {
        mFrame = shot.frames.first;
        mWindow.setFrame(mFrame);
        mWindow.canvas().fit();
        Q_EMIT projectOpened(mProject);
    }
    const auto isSame = [](const Layer& a, const Layer& b)
    {
        return a.name == b.name && a.visible == b.visible;
    };
    const QVector<Layer>& old = before.layers;
    if (!opened.isEmpty() ||
        !std::equal(shot.layers.begin(), shot.layers.end(), old.begin(), old.end(), isSame))
        Q_EMIT layersChanged();
    if (before.frames.last != shot.frames.last)
        Q_EMIT frameCountChanged(shot.frames.last);
    goToFrame(mFrame);
    if (!opened.isEmpty() && mTool != nullptr)
    {
        mTool->setEnabled(true);
        mTool->setChecked(true);
    }
    Q_EMIT viewChanged();
}

void WindowHost::onFrameRead(int frame, const LayeredFrame& shown)
{
    const auto before = mExports.frames().constFind(frame);
    const bool isNew = before == mExports.frames().constEnd();
    const bool isChanged = !isNew && (mHasFailed || !before->isSame(shown));
    const bool isMoved = frame == mFrame && (isNew || before->view != shown.view);
    if (isNew || isChanged)
        mExports.setFrame(frame, shown);
    if (frame == mFrame && (isNew || isChanged))
        show();
    if (isMoved)
        Q_EMIT viewChanged();
    if (isChanged)
        Q_EMIT drawingChanged(frame);
    const int total = frameCount() - firstFrame() + 1;
    const int read = mExports.frames().size();
    if (read < total)
        showStatus(tr("Reading the drawings: %1 of %2").arg(read).arg(total), ReadingMs);
}

void WindowHost::onFailed(const UserError& error)
{
    mHasFailed = mOpening.isEmpty();
    if (error.kind != UserError::Kind::NoWorker)
        mOpening.clear();
    Q_EMIT problem(error);
}

void WindowHost::show()
{
    const auto shown = mExports.frames().constFind(mFrame);
    if (shown == mExports.frames().constEnd())
        return;
    if (shown->error)
        Q_EMIT problem(*shown->error);
    mPainter.cancel();
    mPainter.paint(mExports.files(mFrame, {}), canvasSize(),
                   [this](const QImage& image) { mWindow.canvas().setPicture(image); });
}

void WindowHost::requestFrames(int first, int last, const QStringList& layers)
{
    for (int frame = first; frame <= last; ++frame)
        mExports.request(frame, layers);
}

} // namespace lampblack
