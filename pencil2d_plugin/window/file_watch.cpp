#include "window/file_watch.h"

#include <QDir>
#include <QFileInfo>

namespace lampblack
{

namespace
{
constexpr int SettleMs = 300;  ///< a program writes a file in several steps
constexpr int MaxFiles = 2000; ///< of a folder; changes within others are not seen
} // namespace

FileWatch::FileWatch(QObject* parent) : QObject(parent)
{
    mSettle.setSingleShot(true);
    mSettle.setInterval(SettleMs);
    connect(&mSettle, &QTimer::timeout, this, &FileWatch::onSettled);
    for (const auto signal : {&QFileSystemWatcher::fileChanged, &QFileSystemWatcher::directoryChanged})
        connect(&mWatcher, signal, &mSettle, qOverload<>(&QTimer::start));
}

void FileWatch::watch(const QString& path)
{
    mSettle.stop();
    mPath = path;
    mIsFile = QFileInfo(path).isFile();
    const QStringList before = mWatcher.files() + mWatcher.directories();
    if (!before.isEmpty())
        mWatcher.removePaths(before);
    follow();
    mState = state();
}

/// Watch what is there now: a file that was replaced is watched no longer.
void FileWatch::follow()
{
    const QFileInfo info(mPath);
    QStringList paths{info.isDir() ? mPath : info.absolutePath()};
    if (info.isFile())
    {
        paths << mPath;
    }
    else if (!mIsFile)
    {
        const QDir folder(paths.first());
        const QStringList names = folder.entryList(QDir::Files).mid(0, MaxFiles);
        for (const QString& name : names)
            paths << folder.filePath(name);
    }
    const QStringList before = mWatcher.files() + mWatcher.directories();
    for (const QString& path : before)
        paths.removeAll(path);
    if (!paths.isEmpty())
        mWatcher.addPaths(paths);
}

void FileWatch::onSettled()
{
    follow();
    if (mIsFile)
    {
        // Beside the file much else may happen. While another takes its place, it is not there.
        const State now = state();
        if (now.bytes < 0 || now == mState)
            return;
        mState = now;
    }
    Q_EMIT changed();
}

FileWatch::State FileWatch::state() const
{
    const QFileInfo info(mPath);
    return info.isFile() ? State{info.size(), info.lastModified()} : State{};
}

} // namespace lampblack
