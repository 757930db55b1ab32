#include "host/camera_survey.h"

#include "host/camera_frame.h"

#include <QSignalBlocker>

#include <utility>

namespace lampblack
{

namespace
{

constexpr int SliceMs = 16; ///< how long a go may block the main thread, but it reads at least one frame
constexpr int PauseMs = 10; ///< between two goes, so that the artist's events are handled
constexpr int RetryMs = 60; ///< while the artist is busy

} // namespace

CameraSurvey::CameraSurvey(const Parts& parts, Idleness* idleness, Transport* transport, ToolPalette* palette,
                           ViewReader* view)
    : mParts(parts), mIdleness(idleness), mTransport(transport), mPalette(palette), mView(view), mRows(parts)
{
    mTimer.setSingleShot(true);
    connect(&mTimer, &QTimer::timeout, this, &CameraSurvey::readOn);
}

void CameraSurvey::begin(int row, const QSize& picture)
{
    mRow = row;
    mPicture = picture;
    CameraSteps steps;
    steps.read = [this]
    {
        return view();
    };
    steps.frame = [this]
    {
        return mTransport->currentFrame();
    };
    steps.goTo = [this](int frame)
    {
        mTransport->goTo(frame);
    };
    const auto triggerOf = [this](const char* name)
    {
        return [action = QPointer<QAction>(mParts.action(name))]
        {
            if (action != nullptr)
                action->trigger();
        };
    };
    steps.toNextKey = triggerOf("actionNext_KeyFrame");
    steps.toPreviousKey = triggerOf("actionPrev_KeyFrame");
    const CameraMoves moves = mParts.isSince07 ? CameraMoves::Curved : CameraMoves::Straight;
    mReading.emplace(moves, mTransport->frameCount(), steps);
    readOn();
}

void CameraSurvey::cancel()
{
    mReading.reset();
    mTimer.stop();
}

void CameraSurvey::readOn()
{
    if (!mReading)
        return;
    if (!mIdleness->isIdle() || mTransport->isPlaying())
    {
        mTimer.start(RetryMs);
        return;
    }
    const bool isRead = readSome();
    if (isRead && !mReading->isDone())
    {
        mTimer.start(PauseMs);
        return;
    }
    const CameraPath path = isRead ? mReading->path() : CameraPath();
    cancel();
    Q_EMIT read(path);
}

bool CameraSurvey::readSome()
{
    const Idleness::Work work(mIdleness);
    const QSignalBlocker still(mTransport);
    const UpdatesOff unseen(mParts.window);
    const int rowBefore = mRows.currentRow();
    const int frameBefore = mTransport->currentFrame();
    bool isRead = false;
    const auto read = [&]
    {
        isRead = mReading->read(MostFrames, SliceMs);
        mTransport->goTo(frameBefore);
        mRows.select(rowBefore);
    };
    mRows.select(mRow);
    if (!mParts.isSince07)
        read();
    // It draws the camera's frame while the tool that moves it is in use.
    else if (!mPalette->workWith(mParts.action("actionMove"), read))
        mRows.select(rowBefore);
    return isRead;
}

std::optional<QTransform> CameraSurvey::view() const
{
    const auto matrices = mView->read();
    if (!matrices)
        return std::nullopt;
    // Pencil2D 0.6 shows the canvas through the camera whose layer is the current one.
    return mParts.isSince07 ? readCameraFrame(mParts.canvas, matrices->widget, mPicture)
                            : std::optional<QTransform>(matrices->view);
}

} // namespace lampblack
