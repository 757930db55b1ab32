// Whether the artist is idle, so that work in the main thread disturbs nobody.
#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QPoint>

namespace lampblack
{

/// From the press to the release of a button, in widget coordinates.
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

    /// No button or pen is down, no menu or dialog is open, no key was pressed just now, and no Work exists.
    bool isIdle() const;

    /// No button or pen is down.
    bool areHandsOff() const;

    /// Exists while we operate the program ourselves: isIdle() is false, and our own clicks emit no signals.
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
    void released(QObject* widget, const lampblack::Gesture& gesture); ///< a button or pen was released
    void keyReleased(int key);                                         ///< without Ctrl, Alt or Meta

private:
    Gesture mGesture;
    bool mPenDown = false;
    int mWork = 0;
    QElapsedTimer mSinceKey;
};

} // namespace lampblack
