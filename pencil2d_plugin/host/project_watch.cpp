#include "host/project_watch.h"

#include "host/title_mark.h"

#include <QApplication>
#include <QEvent>
#include <QFileInfo>

namespace lampblack
{

namespace
{

constexpr int CheckDelayMs = 120; ///< time for Pencil2D to load, name and draw a project

QDateTime writtenAt(const QString& path)
{
    return path.isEmpty() ? QDateTime() : QFileInfo(path).lastModified();
}

} // namespace

QString projectOf(const QString& title)
{
    QString path = withoutMark(title);
    path.remove(QStringLiteral("[*]"));
    const QFileInfo file(path);
    const bool known = file.suffix() == QLatin1String("pclx") || file.suffix() == QLatin1String("pcl");
    return file.isAbsolute() && known ? file.filePath() : QString();
}

ProjectWatch::ProjectWatch(const Parts& parts, QObject* parent)
    : QObject(parent), mParts(parts), mPath(projectOf(parts.window->windowTitle())),
      mWrittenAt(writtenAt(mPath))
{
    mCheckTimer.setSingleShot(true);
    mCheckTimer.setInterval(CheckDelayMs);
    connect(&mCheckTimer, &QTimer::timeout, this, &ProjectWatch::checkProject);
    parts.window->installEventFilter(this);
    connect(qApp, &QCoreApplication::aboutToQuit, this, &ProjectWatch::checkSaved);
    if (has(parts.editor, "objectLoaded()"))
        connect(parts.editor, SIGNAL(objectLoaded()), this, SLOT(onLoaded()));
    for (const char* name : {"actionSave", "actionSave_as"})
    {
        if (QAction* action = parts.action(name))
            connect(action, &QAction::triggered, &mCheckTimer, qOverload<>(&QTimer::start));
    }
}

ProjectWatch::~ProjectWatch()
{
    if (mParts.window != nullptr)
        mParts.window->removeEventFilter(this);
}

bool ProjectWatch::open(const QString& path)
{
    if (!has(qApp, "openFileRequested(QString)") || !QFileInfo(path).isFile())
        return false;
    return QMetaObject::invokeMethod(qApp, "openFileRequested", Qt::QueuedConnection, Q_ARG(QString, path));
}

bool ProjectWatch::save()
{
    QAction* action = mParts.action("actionSave");
    if (action == nullptr || mPath.isEmpty())
        return false;
    action->trigger();
    return writtenAt(mPath) != mWrittenAt;
}

bool ProjectWatch::eventFilter(QObject*, QEvent* event)
{
    if (event->type() == QEvent::WindowTitleChange || event->type() == QEvent::ModifiedChange)
        mCheckTimer.start();
    return false;
}

void ProjectWatch::onLoaded()
{
    mLoaded = true;
    mCheckTimer.start();
}

void ProjectWatch::checkProject()
{
    if (mParts.window == nullptr)
        return;
    // While a project is read, Pencil2D shows a modal progress dialog.
    if (QApplication::activeModalWidget() != nullptr)
    {
        mCheckTimer.start();
        return;
    }
    const QString path = projectOf(mParts.window->windowTitle());
    if (!mLoaded)
    {
        if (path != mPath)
            mWrittenAt = QDateTime();
        mPath = path;
        checkSaved();
        return;
    }
    checkSaved(); // the project before may have been saved on leaving it
    mLoaded = false;
    mPath = path;
    mWrittenAt = writtenAt(path);
    Q_EMIT opened(path);
}

void ProjectWatch::checkSaved()
{
    const QDateTime written = writtenAt(mPath);
    if (written == mWrittenAt)
        return;
    mWrittenAt = written;
    Q_EMIT saved(mPath);
}

} // namespace lampblack
