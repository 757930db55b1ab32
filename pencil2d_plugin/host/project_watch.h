// Knows which project is open, and detects when it is opened and saved.
#pragma once

#include "host/parts.h"

#include <QDateTime>
#include <QTimer>

namespace lampblack
{

/// The project's path in a window title ("[*]/shots/walk.pclx"); empty if there is none.
QString projectOf(const QString& title);

class ProjectWatch : public QObject
{
    Q_OBJECT

public:
    ProjectWatch(const Parts& parts, QObject* parent);
    ~ProjectWatch() override;

    QString path() const { return mPath; }
    bool isModified() const { return mParts.window != nullptr && mParts.window->isWindowModified(); }
    bool open(const QString& path);
    bool save();

    bool eventFilter(QObject* watched, QEvent* event) override;

Q_SIGNALS:
    void opened(const QString& path);
    void saved(const QString& path);

private Q_SLOTS:
    void onLoaded();

private:
    void checkProject();
    void checkSaved();

    Parts mParts;
    QTimer mCheckTimer;
    QString mPath;
    QDateTime mWrittenAt; ///< time of the file when it was last checked
    bool mLoaded = false;
};

} // namespace lampblack
