// Whether the artist's hands are off, so that work on Qt's main thread goes unnoticed.
#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QPoint>

namespace lampblack
{

/// From a button's press to its release, in the widget's coordinates.
struct Gesture
{
    QPoint from;
    QPoint to;
    bool doubleClick = false;
};

class Idleness : public QObject
{
    Q_OBJECT

public:
    explicit Idleness(QObject* parent);

    /// No button or pen is down, no menu or dialog is open, nothing was typed just now, and none of our
    /// own work is under way.
    bool isIdle() const;

    /// No button or pen is down.
    bool areHandsOff() const;

    /// While it lives, we drive the program ourselves: isIdle() is false and what we click is not told.
    class Work
    {
    public:
        explicit Work(Idleness* idleness) : mIdleness(idleness) { ++mIdleness->mWork; }
        ~Work() { --mIdleness->mWork; }
        Q_DISABLE_COPY_MOVE(Work)

    private:
        Idleness* mIdleness;
    };
    bool isWorking() const { return mWork > 0; }

    bool eventFilter(QObject* watched, QEvent* event) override;

Q_SIGNALS:
    void released(QObject* where, const lampblack::Gesture& gesture); ///< a button or pen went up
    void keyReleased(int key);                                        ///< without Ctrl, Alt or Meta

private:
    Gesture mGesture;
    bool mPenDown = false;
    int mWork = 0;
    QElapsedTimer mSinceKey;
};

} // namespace lampblack
