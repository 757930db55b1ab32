// The current frame, length, speed and playback of the animation.
#pragma once

#include "host/parts.h"

namespace lampblack
{

/// The frame in a time label ("0012", "00:01:00 | 0012"); 0 if there is none.
int frameOf(const QString& label);

class Transport : public QObject
{
    Q_OBJECT

public:
    Transport(const Parts& parts, QObject* parent);

    int currentFrame() const { return mFrame; }
    void goTo(int frame);
    int frameCount() const { return mCount; }
    double framesPerSecond() const;
    bool isPlaying() const { return mPlaying; }
    FrameRange loopRange() const;

    void setFrameCount(int count);

Q_SIGNALS:
    void frameChanged(int frame);
    void frameCountChanged(int count);
    void playingChanged(bool playing);

private Q_SLOTS:
    void onScrubbed(int frame);
    void onLengthChanged(int length);
    void onPlayState(bool playing);

private:
    Parts mParts;
    int mFrame = 1;
    int mCount = 1;
    bool mPlaying = false;
};

} // namespace lampblack
