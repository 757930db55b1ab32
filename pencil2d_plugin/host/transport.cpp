#include "host/transport.h"

#include "host/timeline_cells.h"

#include <QLabel>
#include <QRegularExpression>
#include <QSignalBlocker>
#include <QSpinBox>

#include <algorithm>

namespace lampblack
{

namespace
{
constexpr int LastFrame = 9999; // of Pencil2D's timeline
}

int frameOf(const QString& label)
{
    static const QRegularExpression frame(QStringLiteral("(?:^|\\|\\s*)(\\d{1,5})\\s*$"));
    const QRegularExpressionMatch match = frame.match(label);
    return match.hasMatch() ? match.captured(1).toInt() : 0;
}

Transport::Transport(const Parts& parts, QObject* parent) : QObject(parent), mParts(parts)
{
    // Connected by name, because we do not have the headers of these classes.
    if (has(parts.editor, "scrubbed(int)"))
        connect(parts.editor, SIGNAL(scrubbed(int)), this, SLOT(onScrubbed(int)));
    if (has(parts.layers, "animationLengthChanged(int)"))
        connect(parts.layers, SIGNAL(animationLengthChanged(int)), this, SLOT(onLengthChanged(int)));
    if (has(parts.playback, "playStateChanged(bool)"))
        connect(parts.playback, SIGNAL(playStateChanged(bool)), this, SLOT(onPlayState(bool)));
    if (parts.timeControls == nullptr)
        return;
    const auto labels = parts.timeControls->findChildren<QLabel*>();
    for (const QLabel* label : labels)
    {
        if (const int frame = frameOf(label->text()); frame > 0)
            mFrame = frame;
    }
}

void Transport::goTo(int frame)
{
    if (mPlaying || frame < 1 || frame > LastFrame || frame == mFrame)
        return;
    const int from = mFrame;
    {
        const QSignalBlocker onTheWay(this);
        if (mParts.trackCells != nullptr)
        {
            // The first frame in sight, in the header.
            const ScrolledCells scroll(mParts.trackCells, Qt::Horizontal, frame - 1);
            sendClick(mParts.trackCells, QPoint(1, TimelineRowHeight / 2));
        }
        // A timeline that is another one is left to the keys.
        QAction* next = mParts.action("actionNext_Frame");
        QAction* previous = mParts.action("actionPrevious_Frame");
        if (next == nullptr || previous == nullptr)
            return;
        int before = 0;
        while (mFrame != frame && mFrame != before)
        {
            before = mFrame;
            (mFrame < frame ? next : previous)->trigger();
        }
    }
    if (mFrame != from)
        Q_EMIT frameChanged(mFrame);
}

double Transport::framesPerSecond() const
{
    constexpr double Default = 12;
    // The first spin box of the controls; the others are the ends of the loop.
    const auto* box = mParts.timeControls == nullptr ? nullptr : mParts.timeControls->findChild<QSpinBox*>();
    return box == nullptr ? Default : box->value();
}

FrameRange Transport::loopRange() const
{
    const FrameRange all{1, mCount};
    if (mParts.timeControls == nullptr)
        return all;
    // Rate, start, end, in this order.
    const auto boxes = mParts.timeControls->findChildren<QSpinBox*>();
    constexpr int Boxes = 3;
    if (boxes.size() != Boxes || !boxes[1]->isEnabled() || boxes[1]->value() > boxes[2]->value())
        return all;
    // The loop may reach beyond the last drawing.
    return {std::min(boxes[1]->value(), mCount), std::min(boxes[2]->value(), mCount)};
}

void Transport::setFrameCount(int count)
{
    if (count < 1 || count == mCount)
        return;
    mCount = count;
    Q_EMIT frameCountChanged(count);
}

void Transport::onScrubbed(int frame)
{
    if (frame == mFrame)
        return;
    mFrame = frame;
    Q_EMIT frameChanged(frame);
}

void Transport::onLengthChanged(int length)
{
    setFrameCount(length);
}

void Transport::onPlayState(bool playing)
{
    if (playing == mPlaying)
        return;
    mPlaying = playing;
    Q_EMIT playingChanged(playing);
}

} // namespace lampblack
